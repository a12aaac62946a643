#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the meshes of hand.toml, putty.toml and game.toml into hand/, as OBJ files in metres.

Python 3, standard library only.

Each mesh stands on its own origin, +Y up, closed and oriented outwards.
"""
import math
import pathlib

FOLDER = pathlib.Path(__file__).with_name("hand")


def ball(radius, rings):
    """A ball whose poles lie on the y axis."""
    points, faces = [(0.0, 0.0, 0.0)], []
    sides = 2 * rings
    for i in range(1, rings):
        angle = math.pi * i / rings
        for k in range(sides):
            around = 2 * math.pi * k / sides
            ring = radius * math.sin(angle)
            points.append((ring * math.cos(around), radius - radius * math.cos(angle), ring * math.sin(around)))
    points.append((0.0, 2 * radius, 0.0))
    top = len(points) - 1
    for i in range(rings - 1):
        for k in range(sides):
            a, b = 1 + i * sides + k, 1 + i * sides + (k + 1) % sides
            if i == 0:
                faces.append((0, a, b))
            if i < rings - 2:
                faces += [(a, a + sides, b), (b, a + sides, b + sides)]
            else:
                faces.append((a, top, b))
    return points, faces


def rounded_box(size, edge, parts):
    """A box with rounded edges: a cube's grid, drawn in to the inner box and out again by the edge's radius."""
    inner = [s / 2 - edge for s in size]
    steps = [-1 + 2 * i / parts for i in range(parts + 1)]
    # A grid that is fine at the edges alone.
    points, faces, known = [], [], {}

    def place(p):
        direction = [math.tan(c * math.pi / 4) for c in p]
        length = math.sqrt(sum(d * d for d in direction))
        corner = [math.copysign(half, c) if abs(c) > 1e-9 else 0.0 for half, c in zip(inner, p)]
        at = [c + edge * d / length for c, d in zip(corner, direction)]
        key = tuple(round(c, 7) for c in (at[0], at[1] + size[1] / 2, at[2]))
        if key not in known:
            known[key] = len(points)
            points.append(key)
        return known[key]

    for axis in range(3):
        for side in (-1, 1):
            for u0, u1 in zip(steps, steps[1:]):
                for v0, v1 in zip(steps, steps[1:]):
                    corners = []
                    for u, v in ((u0, v0), (u1, v0), (u1, v1), (u0, v1)):
                        p = [0.0, 0.0, 0.0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, u, v
                        corners.append(place(p))
                    if side < 0:
                        corners.reverse()
                    for face in ((corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])):
                        if len(set(face)) == 3:
                            faces.append(face)
    return points, faces


def turned(profile, sides):
    """Turns (radius, height) pairs, whose first and last lie on the axis, about +Y."""
    points, rings, faces = [], [], []
    for radius, height in profile:
        count = sides if radius > 0 else 1
        rings.append([len(points) + k for k in range(count)])
        for k in range(count):
            angle = 2 * math.pi * k / sides
            points.append((radius * math.cos(angle), height, radius * math.sin(angle)))
    for low, high in zip(rings, rings[1:]):
        for k in range(sides):
            a, b = low[k % len(low)], low[(k + 1) % len(low)]
            d, c = high[k % len(high)], high[(k + 1) % len(high)]
            faces += [f for f in ((a, d, c), (a, c, b)) if len(set(f)) == 3]
    return points, faces


def write(name, mesh):
    points, faces = mesh
    lines = ["# SPDX-License-Identifier: MIT", f"# {name}: made by make_hand.py; metres"]
    lines += ["v %.7f %.7f %.7f" % p for p in points]
    lines += ["f %d %d %d" % tuple(i + 1 for i in f) for f in faces]
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / f"{name}.obj").write_text("\n".join(lines) + "\n", encoding="ascii")


write("ball", ball(0.035, 40))
write("box", rounded_box((0.05, 0.05, 0.05), 0.003, 9))
write("card", rounded_box((0.05, 0.075, 0.016), 0.004, 9))
write("table", rounded_box((0.3, 0.02, 0.24), 0.004, 9))
write("floor", rounded_box((0.4, 0.02, 0.5), 0.004, 9))
write("wall", rounded_box((0.4, 0.47, 0.02), 0.004, 9))
write("line", rounded_box((0.4, 0.004, 0.002), 0.0005, 3))
write("stand", turned([(0.0, 0.0), (0.021, 0.0), (0.022, 0.001), (0.022, 0.003), (0.021, 0.004), (0.011, 0.007),
                       (0.008, 0.012), (0.008, 0.04), (0.011, 0.046), (0.016, 0.049), (0.0155, 0.05), (0.0, 0.046)], 40))
