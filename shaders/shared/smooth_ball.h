// SPDX-License-Identifier: MIT
// The arithmetic of smoothing within a ball that moves along a segment, for C++ and GLSL: how strong it is at a place,
// and what becomes of an end there. compute/tools/smooth.hpp says what it does. Lengths in cells.
#ifndef BURIN_SHARED_SMOOTH_BALL_H
#define BURIN_SHARED_SMOOTH_BALL_H
#include "shaders/shared/dexel.h"
#include "shaders/shared/normal_code.h"
#include "shaders/shared/smooth_field.h"

BURIN_SHARED_BEGIN

// The least width of a kernel. One that ought to be narrower moves the surface by a share of what this one does.
const double kLeastWidth = 3.0;
const int kMostWaves = 8;  // cells by which the surface may move into a node's neighbours
const int kNewtonSteps = 3;

// Numbers that no float holds.
#ifdef __cplusplus
const double kLeastArea = 1e-6, kLeastSlope = 1e-3, kSmallStep = 0.01, kLeastMove = 0.01, kLeastTurn = 1e-9;
const double kGaussAt[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
const double kGaussWeight[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
#else
const double kLeastArea = 1e-6lf, kLeastSlope = 1e-3lf, kSmallStep = 0.01lf, kLeastMove = 0.01lf, kLeastTurn = 1e-9lf;
const double kGaussAt[4] = {0.0694318442029737lf, 0.3300094782075719lf, 0.6699905217924281lf, 0.9305681557970263lf};
const double kGaussWeight[4] = {0.1739274225687269lf, 0.3260725774312731lf, 0.3260725774312731lf, 0.1739274225687269lf};
#endif

// The path of the ball's middle.
struct SmoothPath {
    Double3 start;
    Double3 along;
    double radius;
    double most_width2;  // square of the width that the kernel would have where the tool acted with full weight
};

// Strength of smoothing at a place within the tool.
struct Smoothing {
    double share;  // of the way to the smoothed surface
    KernelWidth width;
};

// Returns the vector from the path to a place.
BURIN_HOT_FN Double3 off_path(SmoothPath path, Double3 place) {
    Double3 p = place - path.start;
    double length2 = dot3(path.along, path.along);
    double t = length2 > 0.0 ? clamp(dot3(p, path.along) / length2, 0.0, 1.0) : 0.0;
    return p - t * path.along;
}

// Returns the smoothing at a place: the mean over the path of (1 - (distance / radius)^2)^3, by Gauss and Legendre.
BURIN_HOT_FN Smoothing smoothing_at(SmoothPath path, Double3 place) {
    double sum = 0.0;
    Double3 by_place = Double3(0.0);
    for (int i = 0; i < 4; ++i) {
        Double3 off = (place - path.start - kGaussAt[i] * path.along) / path.radius;
        double inside = 1.0 - dot3(off, off);
        if (inside > 0.0) {
            sum += kGaussWeight[i] * inside * inside * inside;
            by_place -= kGaussWeight[i] * 6.0 * inside * inside / path.radius * off;
        }
    }
    double width2 = path.most_width2 * sum;
    Smoothing smoothing;
    smoothing.share = 1.0;
    if (width2 < kLeastWidth * kLeastWidth) {
        smoothing.share = width2 / (kLeastWidth * kLeastWidth);
        smoothing.width.value = kLeastWidth;
        smoothing.width.gradient = Double3(0.0);
    } else {
        smoothing.width.value = sqrt(width2);
        smoothing.width.gradient = path.most_width2 / (2.0 * smoothing.width.value) * by_place;
    }
    return smoothing;
}

BURIN_HOT_FN Double3 decoded_normal(uint code) {
    Direction d = decode_normal(code);
    return Double3(double(d.x), double(d.y), double(d.z));
}

// Returns the place of a depth on a ray.
BURIN_HOT_FN Double3 place_on_ray(int axis, int u, int v, int depth) {
    double s = double(depth) / double(kUnitsPerCell);
    if (axis == 0) return Double3(s, double(u), double(v));
    if (axis == 1) return Double3(double(v), s, double(u));
    return Double3(double(u), double(v), s);
}

// Returns the area for which an end along an axis stands. The shares of the three axes in an area add up to one, and
// that of an axis falls off smoothly to where its rays graze the surface.
BURIN_HOT_FN double area_of_end(Double3 normal, int axis) {
    Double3 n2 = normal * normal;
    double share = n2[axis] * n2[axis] / dot3(n2, n2);
    return share / max(abs(normal[axis]), kLeastArea);
}

// Returns what the field at a node, or between two ends, becomes when it goes a share of the way to the smoothed one.
BURIN_HOT_FN double part_of_way(double was, double share, double distance) { return was + share * (distance - was); }

// Returns the distance of a node from the plane of an end on one of its edges.
BURIN_HOT_FN double distance_of_end(DexelEnd end, int axis, int node) {
    double along = abs(double(depth_of(end)) / double(kUnitsPerCell) - double(node));
    return along * abs(decoded_normal(end.normal)[axis]);
}

// A lattice edge, from the node at `low` on a ray one cell along it.
struct SmoothEdge {
    int axis;
    int u;
    int v;
    int low;
};
BURIN_HOT_FN Double3 place_on_edge(SmoothEdge edge, double share) {
    double s = double(edge.low) + share;
    if (edge.axis == 0) return Double3(s, double(edge.u), double(edge.v));
    if (edge.axis == 1) return Double3(double(edge.v), s, double(edge.u));
    return Double3(double(edge.u), double(edge.v), s);
}
BURIN_HOT_FN double share_of_depth(SmoothEdge edge, int depth) {
    return double(depth) / double(kUnitsPerCell) - double(edge.low);
}

// Returns half of what is between two ends of an edge.
BURIN_HOT_FN double half_between(DexelEnd from, DexelEnd to) {
    return 0.5 * double(depth_of(to) - depth_of(from)) / double(kUnitsPerCell);
}
// Tells whether what is between two ends of an edge has vanished, by the field in its middle.
BURIN_HOT_FN bool has_vanished(SmoothEdge edge, DexelEnd from, double half_gap, bool is_inside, double share,
                               double distance) {
    double sign = is_inside ? -1.0 : 1.0;
    double was = sign * half_gap * abs(decoded_normal(from.normal)[edge.axis]);
    return sign * part_of_way(was, share, distance) <= 0.0;
}

// Returns the depth of an end on the edge above a node, at a share of the edge.
BURIN_HOT_FN int depth_on_edge(int node, double share) {
    double units = clamp(floor(share * double(kUnitsPerCell) + 0.5), 1.0, double(kUnitsPerCell));
    return node * kUnitsPerCell + int(units);
}

// Returns how far along an edge the field's zero is by Newton's method, half a cell at most.
BURIN_HOT_FN double newton_step(double distance, double slope) {
    double divisor = abs(slope) > kLeastSlope ? slope : (has_minus(slope) ? -kLeastSlope : kLeastSlope);
    return clamp(-distance / divisor, -0.5, 0.5);
}

// Tells whether an end stays as it is where smoothing has this share.
BURIN_HOT_FN bool is_too_weak(double share) { return share * 0.5 * double(kUnitsPerCell) < kLeastMove; }

// Returns an end that goes a share of the way to the root of the field on its edge, whose gradient there is `gradient`.
BURIN_HOT_FN DexelEnd moved_end(DexelEnd old, int node, double was, double root, double share, Double3 gradient) {
    Double3 before = decoded_normal(old.normal);
    double length = length3(gradient);
    Double3 turn = Double3(0.0);
    if (length > 0.0) turn = share * (gradient / length - before);
    bool turns = dot3(turn, turn) > kLeastTurn;
    return make_end(depth_on_edge(node, was + share * (root - was)), material_of(old),
                    turns ? normal_code(before + turn) : old.normal);
}

// Returns an end on an edge that had none, or several, with the field's gradient there. Where that is unknown or points
// the other way, the normal is along the ray.
BURIN_HOT_FN DexelEnd made_end(SmoothEdge edge, double share, uint material, bool low_inside, bool known,
                               Double3 gradient) {
    double outwards = low_inside ? 1.0 : -1.0;
    bool faces = known && gradient[edge.axis] * outwards > 0.0;
    return make_end(depth_on_edge(edge.low, share), material,
                    normal_code(faces ? gradient : axis_vector(edge.axis) * outwards));
}

BURIN_SHARED_END
#endif
