#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes tube.csv: a short wand is taken through the tube of assets/worlds/tube.wrl, from the left end to the right.

Units: seconds, metres; frame: the tube's world. The handle stands upright and nods and rolls a little; its middle sways
about the tube's middle line by more than there is room for, so that its ends touch the wall in turn.
"""
import math
import pathlib
import runpy

TUBE = runpy.run_path(str(pathlib.Path(__file__).parents[1] / "worlds" / "make_tube.py"))
DURATION_S, STEP_S = 10.0, 0.02
SWAY_UP, SWAY_SIDE = 0.030, 0.034  # metres; the wall is 0.045 off the line, the ends of the wand 0.02 off its middle
NOD, ROLL = 0.25, 0.2  # radians


def quaternion(pitch, roll):
    """The turn by pitch about x after the one by roll about z, as x, y, z, w."""
    a, b = 0.5 * pitch, 0.5 * roll
    return (
        math.sin(a) * math.cos(b),
        -math.sin(a) * math.sin(b),
        math.cos(a) * math.sin(b),
        math.cos(a) * math.cos(b),
    )


def main():
    rows = ["time_s,x_m,y_m,z_m,qx,qy,qz,qw,button"]
    steps = round(DURATION_S / STEP_S)
    for k in range(steps + 1):
        u = k / steps
        s = u * u * (3.0 - 2.0 * u)  # rests at both ends
        t = -0.97 + 1.94 * s
        x, y, z = TUBE["middle"](t)
        dx, _, dz = TUBE["direction"](t)
        side = math.hypot(dx, dz)
        swell = math.sin(math.pi * u)
        up = SWAY_UP * swell * math.sin(6.0 * math.pi * u)
        across = SWAY_SIDE * swell * math.sin(4.0 * math.pi * u)
        place = (x + across * dz / side, y + up, z - across * dx / side)
        q = quaternion(NOD * swell * math.sin(8.0 * math.pi * u), ROLL * swell * math.sin(10.0 * math.pi * u))
        rows.append(
            f"{k * STEP_S:.2f}," + ",".join(f"{p:.5f}" for p in place) + "," + ",".join(f"{c:.6f}" for c in q) + ",0"
        )
    pathlib.Path(__file__).with_name("tube.csv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
