#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws force and torque over time of five tools along assets/strokes/turning.csv, from what `burin sculpt` wrote.

    for tool in cylinder:0.002,0.006 cone:0.0005,0.003,0.006 bullnose:0.002,0.0007,0.006 box:0.004,0.003,0.005 \\
                mesh:assets/tools/hex-bar.obj; do
        burin sculpt --workpiece block:0.06,0.04,0.02 --units m --tool $tool --hand simulated --press 0.5 \\
                     --stroke assets/strokes/turning.csv --resolution 192 --report ${tool%%:*}.json
    done
    docs/pictures/make_five_tools.py . > docs/pictures/five-tools.svg
"""
import csv
import math
import sys

TOOLS = [("cylinder", "cylinder, 4 mm"), ("cone", "cone, 1 to 6 mm"), ("bullnose", "bull-nose, 4 mm"),
         ("box", "box, 4 x 3 x 5 mm"), ("mesh", "six-sided bar, 5 mm")]
WIDTH, ROW, LEFT, RIGHT, TOP, GAP = 960, 112, 70, 20, 34, 40


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    t = [float(r["time_s"]) for r in rows]
    size = lambda r, name, unit: math.sqrt(sum(float(r[f"{name}_{a}_{unit}"]) ** 2 for a in "xyz"))
    return t, [size(r, "force", "N") for r in rows], [1e3 * size(r, "torque", "Nm") for r in rows]


def band(t, values, x0, width, y0, height, t_end, most):
    """One upright stroke for each pixel column, from the least to the greatest value in it."""
    columns = {}
    for time, value in zip(t, values):
        columns.setdefault(int(width * time / t_end), []).append(value)
    path = []
    for x, v in sorted(columns.items()):
        low, high = (y0 + height * (1.0 - min(e, most) / most) for e in (min(v), max(v)))
        path.append(f"M{x0 + x + 0.5} {low + 0.5:.1f}V{high:.1f}")
    return "".join(path)


def main():
    data = [read(f"{sys.argv[1]}/{name}-felt.csv") for name, _ in TOOLS]
    t_end = max(t[-1] for t, _, _ in data)
    tops = [max(max(d[k]) for d in data) for k in (1, 2)]
    plot = (WIDTH - LEFT - RIGHT - GAP) // 2
    height = TOP + ROW * len(TOOLS) + 26
    print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" font-family="sans-serif" '
          f'font-size="12"><rect width="{WIDTH}" height="{height}" fill="white"/>')
    for column, title in enumerate(["force on the hand, N", "torque about the hand, mN m"]):
        x0 = LEFT + column * (plot + GAP)
        print(f'<text x="{x0}" y="20" font-weight="bold">{title}</text>')
        for row, (name, label) in enumerate(TOOLS):
            y0, inner = TOP + ROW * row + 8, ROW - 26
            print(f'<rect x="{x0}" y="{y0}" width="{plot}" height="{inner}" fill="#f4f4f2"/>')
            for share in (0.0, 0.5, 1.0):
                y = y0 + inner * (1 - share)
                print(f'<path d="M{x0} {y}h{plot}" stroke="#ccc"/>'
                      f'<text x="{x0 - 6}" y="{y + 4}" text-anchor="end" fill="#555">{share * tops[column]:.2g}</text>')
            t = data[row][0]
            d = band(t, data[row][1 + column], x0, plot, y0, inner, t_end, tops[column])
            print(f'<path d="{d}" stroke="{["#b4562a", "#2a6db4"][column]}" fill="none"/>')
            print(f'<text x="{x0 + 6}" y="{y0 + 14}">{label}</text>')
        for k in range(0, int(t_end) + 1):
            x = x0 + plot * k / t_end
            print(f'<text x="{x}" y="{height - 8}" text-anchor="middle" fill="#555">{k} s</text>')
    print("</svg>")


main()
