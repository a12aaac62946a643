#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes tube.wrl: a curved tube with a funnel and a thin cap at each end. Python 3, standard library only."""
import math
import pathlib

RADIUS = 0.045  # of the tube, metres
FUNNEL, FUNNEL_ENDS = 0.068, 0.03  # widest radius of a funnel, and how far beyond the middle line's end it is
STRAIGHT = 0.0075  # the tube goes on straight by so much, so that its last ring stands square to the funnel
SECTION = 32  # sides of the tube
POINTS = 49  # of the tube's spine

# The middle line: from the left front up and back over the origin to the right front, level at both ends.
HALF_LENGTH, LOWEST, RISE, FRONT, BACK = 0.165, 0.165, 0.09, 0.11, -0.13


def middle(t):
    """The middle line's point at t, from -1 to 1."""
    bow = math.cos(0.5 * math.pi * t) ** 2
    return (HALF_LENGTH * t, LOWEST + RISE * bow, FRONT + (BACK - FRONT) * bow)


def direction(t):
    a, b = middle(t - 1e-6), middle(t + 1e-6)
    d = [y - x for x, y in zip(a, b)]
    length = math.sqrt(sum(x * x for x in d))
    return [x / length for x in d]


def along(t, distance):
    """A point on the straight continuation of the line at t."""
    return tuple(p + distance * d for p, d in zip(middle(t), direction(t)))


def number(x):
    """Nanometres: an extrusion takes the turn of its first ring from small differences along the spine."""
    text = f"{x:.9f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def numbers(points):
    return ",\n      ".join(" ".join(number(x) for x in p) for p in points)


def corner_of_the_tube():
    """The angle about the world's x, from +y, at which the tube's rings have a corner: that of its bend's normal."""
    return math.atan2(RISE, FRONT - BACK)


def part(name, colour, spine, scales, caps, solid, turn=0.0):
    section = [
        (math.cos(turn + 2 * math.pi * i / SECTION), -math.sin(turn + 2 * math.pi * i / SECTION))
        for i in range(SECTION)
    ]
    section.append(section[0])
    return f"""
DEF {name} Shape {{
  appearance Appearance {{ material HapticMaterial {{ diffuseColor {colour} }} }}
  geometry Extrusion {{
    solid {solid}
    beginCap {caps}
    endCap {caps}
    creaseAngle 0.5
    crossSection [
      {numbers(section)}
    ]
    spine [
      {numbers(spine)}
    ]
    scale [
      {numbers((s, s) for s in scales)}
    ]
  }}
}}
"""


HEAD = """#VRML V2.0 utf8
# A curved tube of radius 0.045 m with a funnel and a thin cap at each end; the caps close the funnels.
# Unit: metre. Origin: that of the wand's world; +X right, +Y up, +Z towards the user. All lies in X -0.24 to 0.24,
# Y 0.085 to 0.335, Z -0.215 to 0.235. Tube and funnels are sheets, felt from both sides. Written by make_tube.py; MIT.

PROTO HapticMaterial [
  exposedField SFColor diffuseColor 0.8 0.8 0.8
  field SFFloat stiffness 700
  field SFFloat damping 0
  field SFFloat staticFriction 0
  field SFFloat dynamicFriction 0
] {
  Material { diffuseColor IS diffuseColor }
}
"""


def main():
    tube = [middle(-1 + 2 * i / (POINTS - 1)) for i in range(POINTS)]
    tube = [along(-1, -STRAIGHT), *tube, along(1, STRAIGHT)]
    text = HEAD + part("Tube", "0.75 0.75 0.8", tube, [RADIUS] * len(tube), "FALSE", "FALSE")
    for name, end, colour in (("Start", -1.0, "0.2 0.7 0.3"), ("End", 1.0, "0.8 0.3 0.2")):
        sign = end
        length = FUNNEL_ENDS - STRAIGHT
        steps = [STRAIGHT + length * i / 6 for i in range(7)]
        radii = [RADIUS + (FUNNEL - RADIUS) * ((s - STRAIGHT) / length) ** 2 for s in steps]
        # A straight spine turns its section by other rules than a bent one; the corners have to meet all the same.
        turn = sign * corner_of_the_tube()
        text += part(name + "Funnel", colour, [along(end, sign * s) for s in steps], radii, "FALSE", "FALSE", turn)
        cap = [along(end, sign * s) for s in (FUNNEL_ENDS, FUNNEL_ENDS + 0.002)]
        text += part(name + "Cap", colour, cap, [FUNNEL] * 2, "TRUE", "TRUE", turn)
    pathlib.Path(__file__).with_name("tube.wrl").write_text(text)


if __name__ == "__main__":
    main()
