#!/usr/bin/env python3
"""Writes turning.csv: a wave over the front of a block, along which the tool turns about its axis and tilts.

For block:0.06,0.04,0.02, whose front is z = 0.02 m. Metres, object frame, the path of the tool's origin, which for
mills is the middle of the tip; the tool's own +Y points out of the front. Python, standard library only."""
import math


def times(a, b):
    """The product of two quaternions x, y, z, w."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def about(axis, angle):
    s = math.sin(0.5 * angle)
    return tuple(s * v for v in axis) + (math.cos(0.5 * angle),)


ROWS, DURATION_S, FRONT_M = 600, 6.0, 0.02
OUTWARD = about((1.0, 0.0, 0.0), 0.5 * math.pi)  # the tool's +Y to the block's +Z

with open("turning.csv", "w", encoding="utf-8") as file:
    file.write("time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n")
    for i in range(ROWS + 1):
        share = i / ROWS
        down = min(1.0, share / 0.06, (1.0 - share) / 0.06)  # in and out at the ends
        x = 0.009 + 0.042 * share
        y = 0.02 + 0.008 * math.sin(2.0 * math.pi * share)
        z = FRONT_M + 0.004 - 0.005 * down
        tilt = about((0.0, 1.0, 0.0), 0.35 * math.sin(3.0 * math.pi * share))
        spin = about((0.0, 1.0, 0.0), 1.5 * share)  # about the tool's own axis
        q = times(tilt, times(OUTWARD, spin))
        values = (share * DURATION_S, x, y, z, *q)
        file.write(",".join(f"{v:.6f}" for v in values) + ",1\n")
