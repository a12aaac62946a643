#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes garden.csv: a hand that presses on each thing of assets/worlds/garden.toml and strokes it.

Units: seconds, metres; frame: the garden's. Heights are where the hand wants to be: some millimetres inside.
"""
import math

SPEED_M_PER_S = 0.09
AWAY = 0.105  # the height at which the hand goes from one thing to the next

# name, where it is touched first, and where it is stroked to
TOUCHES = [
    ("stone", (-0.112, 0.034, 0.055), (-0.095, 0.034, 0.060)),
    ("mushroom", (-0.018, 0.038, 0.065), (-0.002, 0.038, 0.068)),
    ("breeze, then pond", (0.085, -0.004, 0.055), (0.105, -0.004, 0.060)),
    ("pot", (0.137, 0.056, -0.055), (0.134, 0.056, -0.042)),
    ("leaf", (0.015, 0.050, -0.020), (0.030, 0.050, -0.028)),
    ("melon", (-0.035, 0.042, 0.000), (-0.024, 0.042, 0.004)),
    ("log", (-0.085, 0.030, -0.060), (-0.062, 0.030, -0.062)),
    ("soil", (-0.150, -0.010, -0.010), (-0.130, -0.010, -0.005)),
]


def main():
    points = [(-0.112, AWAY, 0.055)]
    for _, first, last in TOUCHES:
        points += [(first[0], AWAY, first[2]), first, last, (last[0], AWAY, last[2])]
    print("time_s,x_m,y_m,z_m,qx,qy,qz,qw,button")
    t = 0.0
    print(f"{t:.3f},{points[0][0]:.5f},{points[0][1]:.5f},{points[0][2]:.5f},0,0,0,1,0")
    for a, b in zip(points, points[1:]):
        way = math.dist(a, b)
        if way == 0.0:
            continue
        slow = 0.35 if a[1] < AWAY and b[1] < AWAY else 1.0
        rows = max(2, math.ceil(way / (slow * SPEED_M_PER_S) / 0.02))
        for k in range(1, rows + 1):
            s = 0.5 - 0.5 * math.cos(math.pi * k / rows)  # rests at both ends
            t += 0.02
            x, y, z = (p + s * (q - p) for p, q in zip(a, b))
            print(f"{t:.3f},{x:.5f},{y:.5f},{z:.5f},0,0,0,1,0")


main()
