#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes ornament.csv: the word BURIN inside a ring with two swelling waves, engraved into the front (+Z) of a ball.

Everything is drawn in millimetres on the plane z = 0 seen from +Z and projected along z onto the ball of 110 mm radius about
the origin. The tool is a ball of 3 mm radius; the path is that of its centre. Depths vary along a line as an engraver's do.
Run it from anywhere: it writes beside itself. Standard library only; the same bytes every time.
"""
import math
import pathlib

BALL_MM, TOOL_MM = 110.0, 3.0
# At this speed the tool cuts in on the first millimetres of a letter; at 50 mm/s it slid over the leg of the R.
CUT_SPEED_MM_S, TRAVEL_SPEED_MM_S, ROW_S = 30.0, 120.0, 0.02
DWELL_S = 0.15
LIFT_MM = 5.0  # how far the tool's surface is above the ball while travelling


def on_ball(x, y, depth):
    z = math.sqrt(BALL_MM**2 - x * x - y * y)
    scale = (BALL_MM + TOOL_MM - depth) / BALL_MM
    return (x * scale, y * scale, z * scale)


def arc(cx, cy, rx, ry, from_deg, to_deg, steps=24):
    return [(cx + rx * math.cos(math.radians(from_deg + (to_deg - from_deg) * i / steps)),
             cy + ry * math.sin(math.radians(from_deg + (to_deg - from_deg) * i / steps))) for i in range(steps + 1)]


def letters():
    """Polylines of the five letters, 24 mm high, about the origin."""
    h, w = 12.0, 11.0
    b = [[(0, -h), (0, h)],
         [(0, h), (6, h)] + arc(6, 6, 4, 6, 90, -90) + [(0, 0)],
         [(0, 0), (6, 0)] + arc(6, -6, 5, 6, 90, -90) + [(0, -h)]]
    u = [[(0, h), (0, -5.5)] + arc(w / 2, -5.5, w / 2, 6.5, 180, 360) + [(w, h)]]
    r = [[(0, -h), (0, h)], [(0, h), (6, h)] + arc(6, 6, 5, 6, 90, -90) + [(0, 0)], [(5.5, 0), (w, -h)]]
    i = [[(0, h), (0, -h)]]
    n = [[(0, -h), (0, h), (w, -h), (w, h)]]
    word = [(b, w), (u, w), (r, w), (i, 0.0), (n, w)]
    gap = 6.4
    x = -(sum(width for _, width in word) + gap * (len(word) - 1)) / 2
    for strokes, width in word:
        for stroke in strokes:
            yield [(px + x, py) for px, py in stroke]
        x += width + gap


def resampled(points, step):
    out = [points[0]]
    for a, b in zip(points, points[1:]):
        length = math.dist(a, b)
        n = max(1, math.ceil(length / step))
        out += [(a[0] + (b[0] - a[0]) * k / n, a[1] + (b[1] - a[1]) * k / n) for k in range(1, n + 1)]
    return out


def lines():
    """Every line as (x, y, depth) in millimetres."""
    step = CUT_SPEED_MM_S * ROW_S
    for stroke in letters():
        yield [(x, y, 1.9) for x, y in resampled(stroke, step)]
    # Deeper than the ball's seams, and a little beyond its beginning.
    yield [(x, y, 1.8) for x, y in resampled(arc(0, 0, 50, 50, 90, 456, 180), step)]
    for middle in (90, 270):
        wave = []
        for k in range(241):
            t = k / 240
            angle = math.radians(middle - 52 + 104 * t)
            radius = 37 + 2.6 * math.cos(2 * math.pi * 6 * t)
            swelling = 1.2 + 0.8 * math.sin(math.pi * t)
            wave.append((radius * math.cos(angle), radius * math.sin(angle), swelling))
        yield wave


def main():
    rows = []  # time, position mm, button
    time = 0.0

    def move(to, speed, button):
        nonlocal time
        time += max(ROW_S, math.dist(rows[-1][1], to) / speed) if rows else 0.0
        rows.append((time, to, button))

    def dwell():
        """A hand waits above the ball before it goes on in another direction: on the ball it would leave a dot."""
        nonlocal time
        time += DWELL_S
        rows.append((time, rows[-1][1], rows[-1][2]))

    for line in lines():
        start, end = line[0], line[-1]
        if rows:  # travel above the ball along a great arc
            ax, ay, _ = last_end
            n = max(2, math.ceil(math.dist((ax, ay), start[:2]) / 4))
            for k in range(1, n + 1):
                move(on_ball(ax + (start[0] - ax) * k / n, ay + (start[1] - ay) * k / n, -LIFT_MM), TRAVEL_SPEED_MM_S, 0)
        else:
            move(on_ball(start[0], start[1], -LIFT_MM), TRAVEL_SPEED_MM_S, 0)
        dwell()
        for k in range(1, 6):  # plunge
            move(on_ball(start[0], start[1], -LIFT_MM + (LIFT_MM + start[2]) * k / 5), CUT_SPEED_MM_S, 1)
        for point in line[1:]:
            move(on_ball(*point), CUT_SPEED_MM_S, 1)
        move(on_ball(end[0], end[1], -LIFT_MM), CUT_SPEED_MM_S, 0)
        last_end = end

    with open(pathlib.Path(__file__).with_name("ornament.csv"), "w", encoding="ascii", newline="\n") as out:
        out.write("time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n")
        for t, p, button in rows:
            out.write(f"{t:.4f},{p[0] / 1000:.6f},{p[1] / 1000:.6f},{p[2] / 1000:.6f},0,0,0,1,{button}\n")


main()
