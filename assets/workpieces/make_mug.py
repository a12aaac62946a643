#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes mug.obj beside this file: a mug without a handle. Standard library only; the same bytes every time.

A profile is turned about +Y in STEPS steps; each of its pieces becomes a ring of quadrilaterals, and the middles of the
bottom's two sides close it. Faces wind counter-clockwise seen from outside.
"""
import math
import os

STEPS = 96
# Radius and height in millimetres, from the bottom's edge up the outer side, over the rim and down to the floor.
PROFILE = [(38, 0), (40, 2), (40, 92), (39, 94), (37, 94), (36, 92), (36, 6), (34, 4)]


def main():
    lines = ["# units mm"]
    for radius, height in PROFILE:
        for i in range(STEPS):
            a = 2 * math.pi * i / STEPS
            lines.append("v %.6f %.6f %.6f" % (radius * math.cos(a), height, -radius * math.sin(a)))
    lines += ["v 0 0 0", "v 0 %d 0" % PROFILE[-1][1]]
    bottom, floor = len(PROFILE) * STEPS + 1, len(PROFILE) * STEPS + 2
    for i in range(STEPS):
        j = (i + 1) % STEPS
        lines.append("f %d %d %d" % (bottom, j + 1, i + 1))
        for ring in range(len(PROFILE) - 1):
            low, high = ring * STEPS + 1, (ring + 1) * STEPS + 1
            lines.append("f %d %d %d %d" % (low + i, low + j, high + j, high + i))
        last = (len(PROFILE) - 1) * STEPS + 1
        lines.append("f %d %d %d" % (floor, last + i, last + j))
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "mug.obj"), "w", encoding="ascii") as out:
        out.write("\n".join(lines) + "\n")


main()
