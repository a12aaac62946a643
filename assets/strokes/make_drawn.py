#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes drawn.csv: a tool, its axis along +z, is drawn twice over the top of block:0.1,0.1,0.05, 0.8 mm deep without
cutting and 3 mm deep while it cuts, at 20 mm/s. Metres, object frame, the path of the tool's origin."""

TOP, ABOVE = 0.05, 0.012
rows = []


def add(x, y, z, button):
    rows.append((0.01 * len(rows), x, y, z, 0.707107, 0.0, 0.0, 0.707107, button))


for y, begin, end, deep, button in ((0.05, 0.03, 0.07, 0.0008, 0), (0.06, 0.07, 0.03, 0.003, 1)):
    for i in range(100):
        add(begin, y, TOP + ABOVE - (ABOVE + deep) * i / 100, button)
    for i in range(200):
        add(begin + (end - begin) * i / 200, y, TOP - deep, button)
    for i in range(100):
        add(end, y, TOP - deep + (ABOVE + deep) * i / 100, button)

with open("drawn.csv", "w", encoding="ascii") as out:
    out.write("time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n")
    for row in rows:
        out.write("%.2f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%d\n" % row)
