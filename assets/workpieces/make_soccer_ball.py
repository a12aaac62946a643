#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes soccer_ball.obj and soccer_ball.mtl beside this file. Standard library only; the same bytes every time.

A truncated icosahedron (12 pentagons, 20 hexagons) projected from its centre on a sphere. Along every edge runs a seam: a
soft groove whose depth depends on the arc distance d to the nearest edge of the panel: DEPTH * cos^2(pi d / WIDTH) for
d < WIDTH / 2, else 0. Each panel is a set of rings around its middle: the outermost ring is the panel's border, shared with
its neighbours vertex by vertex, and rings lie close together within the groove. Triangles wind counter-clockwise seen
from outside. A hexagon's middle lies on +Z, towards the viewer, with two of its edges level.
"""
import math
import os

RADIUS = 0.110  # m; a full-size ball
DEPTH = 0.001  # m, of a seam
WIDTH = 0.003  # m, of a seam, both sides together
BORDER_STEPS = 18  # edges of the mesh along one edge of a panel: 2.5 mm
IN_SEAM = (0.0004, 0.0008, 0.0012, 0.0016)  # m, distances of the rings within a seam from the panel's edge
RING_STEP = 0.0032  # m, between rings on the open panel


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scale(s, a):
    return (s * a[0], s * a[1], s * a[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scale(1.0 / math.sqrt(dot(a, a)), a)


def blend(a, b, t):
    """The point on the great circle through unit vectors a and b at the fraction t of the angle between them."""
    angle = math.acos(max(-1.0, min(1.0, dot(a, b))))
    if angle < 1e-12:
        return a
    return unit(add(scale(math.sin((1 - t) * angle), a), scale(math.sin(t * angle), b)))


def around(axis, points):
    """The points in counter-clockwise order around the axis, seen from outside."""
    u = unit(cross((0.3, 0.5, 0.8), axis))
    v = cross(axis, u)
    return sorted(points, key=lambda p: math.atan2(dot(p, v), dot(p, u)))


def panels():
    """32 tuples (middle, corners), all unit vectors: the 12 pentagons first."""
    golden = (1 + math.sqrt(5)) / 2
    tips = []
    for s in (-1, 1):
        for g in (-golden, golden):
            tips += [(0, s, g), (s, g, 0), (g, 0, s)]
    near = lambda a, b: a != b and abs(dot(a, b) - golden) < 1e-9  # neighbours on the icosahedron (edge 2)
    third = lambda a, b: unit(add(scale(2 / 3, a), scale(1 / 3, b)))  # the corner that truncation leaves near a
    result = []
    for a in tips:
        result.append((unit(a), around(unit(a), [third(a, b) for b in tips if near(a, b)])))
    for i, a in enumerate(tips):
        for j, b in enumerate(tips):
            for k, c in enumerate(tips):
                if i < j < k and near(a, b) and near(b, c) and near(c, a):
                    middle = unit(add(a, add(b, c)))
                    corners = [third(p, q) for p, q in ((a, b), (b, a), (b, c), (c, b), (c, a), (a, c))]
                    result.append((middle, around(middle, corners)))
    return result


def turned_to_viewer(all_panels):
    """Rotated so that the middle of a hexagon lies on +Z and the middle of one of its edges above it."""
    middle, corners = all_panels[12]
    up = unit(add(corners[0], corners[1]))
    x = unit(cross(up, middle))
    y = cross(middle, x)
    turn = lambda p: (dot(p, x), dot(p, y), dot(p, middle))
    return [(turn(m), [turn(c) for c in cs]) for m, cs in all_panels]


class Mesh:
    def __init__(self):
        self.vertices, self.numbers = [], {}

    def vertex(self, p):
        """Numbers a position; what is the same when written is the same vertex, so neighbours share their border."""
        text = " ".join("0" if abs(c) < 5e-7 else f"{c:.6f}" for c in p)
        if text not in self.numbers:
            self.numbers[text] = len(self.vertices) + 1
            self.vertices.append(text)
        return self.numbers[text]


def recessed(direction, corners):
    """The surface point in a direction that lies within the panel."""
    n = len(corners)
    distance = min(
        RADIUS * abs(math.asin(dot(direction, unit(cross(corners[i], corners[(i + 1) % n]))))) for i in range(n)
    )
    depth = DEPTH * math.cos(math.pi * distance / WIDTH) ** 2 if distance < WIDTH / 2 else 0.0
    return scale(RADIUS - depth, direction)


def rings(middle, corners):
    """(fraction of the way to the middle, steps along a side) of each ring from the border inwards."""
    inner = RADIUS * math.acos(dot(middle, unit(add(corners[0], corners[1]))))  # from the middle to an edge's middle
    distances = [0.0, *IN_SEAM]
    count = max(1, round((inner - IN_SEAM[-1]) / RING_STEP))
    distances += [IN_SEAM[-1] + (inner - IN_SEAM[-1]) * k / count for k in range(1, count)]
    for d in distances:
        steps = BORDER_STEPS if d <= IN_SEAM[-1] else max(1, math.ceil((BORDER_STEPS - 4) * (1 - d / inner)))
        yield d / inner, steps


def stitched(outer, inner):
    """Triangles between two rows of vertices that run the same way, the inner one on the left."""
    i = j = 0
    while i + 1 < len(outer) or j + 1 < len(inner):
        # Advance where less of the way is done, so that the diagonals stay short.
        if j + 1 == len(inner) or (i + 1 < len(outer) and (i + 1) * (len(inner) - 1) <= (j + 1) * (len(outer) - 1)):
            yield outer[i], outer[i + 1], inner[j]
            i += 1
        else:
            yield outer[i], inner[j + 1], inner[j]
            j += 1


def panel_triangles(mesh, middle, corners):
    """Side by side from the border inwards, last the fan around the middle."""
    n = len(corners)
    tip = mesh.vertex(recessed(middle, corners))
    for side in range(n):
        a, b = corners[side], corners[(side + 1) % n]
        previous = None
        for inwards, steps in rings(middle, corners):
            # Both neighbours of a border must compute it from the same end, to the last digit.
            low, high = (a, b) if a < b else (b, a)
            row = []
            for k in range(steps + 1):
                t = k / steps if a < b else 1 - k / steps
                row.append(mesh.vertex(recessed(blend(blend(low, high, t), middle, inwards), corners)))
            if previous:
                yield from stitched(previous, row)
            previous = row
        for p, q in zip(previous, previous[1:]):
            yield p, q, tip


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    mesh, faces = Mesh(), {"black": [], "white": []}
    for middle, corners in turned_to_viewer(panels()):
        faces["black" if len(corners) == 5 else "white"] += panel_triangles(mesh, middle, corners)
    with open(os.path.join(folder, "soccer_ball.obj"), "w", newline="\n") as out:
        out.write("# SPDX-License-Identifier: MIT\n# Made by make_soccer_ball.py; metres. See README.md.\n")
        out.write("mtllib soccer_ball.mtl\n")
        out.writelines(f"v {v}\n" for v in mesh.vertices)
        for material, triangles in faces.items():
            out.write(f"usemtl {material}\n")
            out.writelines("f %d %d %d\n" % t for t in triangles)
    with open(os.path.join(folder, "soccer_ball.mtl"), "w", newline="\n") as out:
        out.write("# SPDX-License-Identifier: MIT\nnewmtl black\nKd 0.08 0.08 0.09\nnewmtl white\nKd 0.93 0.93 0.91\n")


if __name__ == "__main__":
    main()
