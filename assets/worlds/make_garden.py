#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the meshes of garden.toml into garden/, as OBJ files in metres. Python 3, standard library only.

Each mesh stands on its own origin, +Y up. All but the leaf are closed and oriented outwards.
"""
import math
import pathlib

FOLDER = pathlib.Path(__file__).with_name("garden")


def volume(points, faces):
    """Six times the signed volume: negative where the faces look inwards."""
    total = 0.0
    for a, b, c in faces:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[a], points[b], points[c]
        total += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
    return total


def revolved(profile, sides, swell=lambda angle, height: 1.0):
    """Turns (radius, height) pairs, whose first and last lie on the axis, about +Y. swell scales radii."""
    points, rings = [], []
    for radius, height in profile:
        count = sides if radius > 0 else 1
        rings.append([len(points) + k for k in range(count)])
        for k in range(count):
            angle = 2 * math.pi * k / sides
            r = radius * swell(angle, height)
            points.append((r * math.cos(angle), height, r * math.sin(angle)))
    faces = []
    for low, high in zip(rings, rings[1:]):
        for k in range(sides):
            a, b = low[k % len(low)], low[(k + 1) % len(low)]
            d, c = high[k % len(high)], high[(k + 1) % len(high)]
            faces += [f for f in ((a, d, c), (a, c, b)) if len(set(f)) == 3]
    return points, faces


def ball(radius, height, rings, flat=1.0):
    """A profile of a ball around (0, height), its height scaled by flat."""
    angles = [math.pi * i / rings for i in range(rings + 1)]
    return [
        (0.0 if i in (0, rings) else radius * math.sin(a), height - flat * radius * math.cos(a))
        for i, a in enumerate(angles)
    ]


def refined(profile, step):
    """The profile with points between, at most a step apart."""
    fine = [profile[0]]
    for (r0, h0), (r1, h1) in zip(profile, profile[1:]):
        parts = max(1, math.ceil(math.hypot(r1 - r0, h1 - h0) / step))
        fine += [(r0 + (r1 - r0) * i / parts, h0 + (h1 - h0) * i / parts) for i in range(1, parts + 1)]
    return fine


def sheet(columns, rows, point):
    """A grid of triangles; point(u, v) for u and v from 0 to 1."""
    points = [point(i / columns, j / rows) for j in range(rows + 1) for i in range(columns + 1)]
    faces = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            faces += [(a, c, b), (a, d, c)]
    return points, faces


def slab(width, depth, height, columns, rows, top):
    """A slab whose upper side is raised by top(x, z), which is 0 at its border."""
    upper, faces = sheet(columns, rows, lambda u, v: ((u - 0.5) * width, 0.0, (v - 0.5) * depth))
    count = len(upper)
    points = [(x, top(x, z), z) for x, _, z in upper] + [(x, -height, z) for x, _, z in upper]
    faces = faces + [(c + count, b + count, a + count) for a, b, c in faces]
    border = [i for i in range(columns + 1)]
    border += [j * (columns + 1) + columns for j in range(1, rows + 1)]
    border += [rows * (columns + 1) + i for i in range(columns - 1, -1, -1)]
    border += [j * (columns + 1) for j in range(rows - 1, 0, -1)]
    for a, b in zip(border, border[1:] + border[:1]):
        faces += [(a, b, b + count), (a, b + count, a + count)]
    return points, faces


def ground(x, z):
    fade = max(0.0, 1 - (x / 0.17) ** 2) * max(0.0, 1 - (z / 0.12) ** 2)
    return fade * (0.003 * math.sin(55 * x + 1) * math.cos(48 * z) + 0.0012 * math.sin(190 * x) * math.sin(170 * z))


def stone(angle, height):
    return 1 + 0.09 * math.sin(2 * angle + 40 * height) + 0.05 * math.sin(5 * angle - 90 * height)


def leaf(u, v):
    along, across = u - 0.5, 2 * v - 1
    half = 0.022 * math.sqrt(max(1 - (2 * along) ** 2, 0.0)) + 0.001
    return (0.09 * along, 0.012 * math.cos(math.pi * along) + 0.006 * across * across, half * across)


POT = [(0, 0), (0.026, 0), (0.036, 0.056), (0.04, 0.056), (0.04, 0.066), (0.034, 0.066), (0.023, 0.006), (0, 0.006)]
MUSHROOM = [(0, 0), (0.009, 0), (0.007, 0.028), (0.021, 0.026), (0.025, 0.03)]
MUSHROOM += [(0.025 * math.cos(a), 0.03 + 0.02 * math.sin(a)) for a in (0.25, 0.5, 0.75, 1.0, 1.25, 1.45)]
MUSHROOM += [(0, 0.05)]
POND = [(0, 0), (0.05, 0), (0.055, 0.004), (0.051, 0.008), (0, 0.008)]
LOG = [(0, -0.06), (0.02, -0.06), (0.02, 0.06), (0, 0.06)]

MESHES = {
    "soil": lambda: slab(0.34, 0.24, 0.02, 44, 32, ground),
    "stone": lambda: revolved(ball(0.032, 0.02, 18, 0.7), 32, stone),
    "pond": lambda: revolved(refined(POND, 0.008), 40),
    "log": lambda: revolved(refined(LOG, 0.006), 54, lambda angle, y: 1 + 0.05 * math.cos(9 * angle + 8 * y)),
    "mushroom": lambda: revolved(refined(MUSHROOM, 0.005), 32),
    "pot": lambda: revolved(refined(POT, 0.007), 40),
    "leaf": lambda: sheet(24, 12, leaf),
    "melon": lambda: revolved(ball(0.03, 0.026, 20, 0.9), 40, lambda angle, y: 1 + 0.025 * math.cos(10 * angle)),
    "bee": lambda: revolved(ball(0.008, 0.0, 12, 1.5), 20),
    "breeze": lambda: revolved(ball(0.03, 0.0, 16), 28),
}


def write(name, points, faces):
    if name != "leaf" and volume(points, faces) < 0:
        faces = [(a, c, b) for a, b, c in faces]
    lines = [f"# {name}: a mesh of garden.toml, written by make_garden.py; MIT.", "# units m; +Y up"]
    lines += ["v " + " ".join(f"{x:.6f}".replace("-0.000000", "0.000000") for x in p) for p in points]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    (FOLDER / f"{name}.obj").write_text("\n".join(lines) + "\n")


def main():
    FOLDER.mkdir(exist_ok=True)
    for name, make in MESHES.items():
        write(name, *make())


if __name__ == "__main__":
    main()
