// SPDX-License-Identifier: MIT
// Computes a point from the tangent planes of the surface in a cell, for feature_point.h. Lengths in cells.
// Bit-identical on the CPU and on every device (portable.h).
#ifndef BURIN_SHARED_FEATURE_PLANES_H
#define BURIN_SHARED_FEATURE_PLANES_H
#include "shaders/shared/feature_constants.h"
#include "shaders/shared/vectors.h"

BURIN_SHARED_BEGIN

// The mean plane of crossings with similar normals.
struct Cluster {
    Float3 first_normal;
    Float3 normal_sum;
    float offset_sum;  // sum of the planes' distances from the mean position, each along its own normal
    float count;
};

BURIN_HOT_FN bool in_cluster(Float3 first_normal, Float3 normal) {
    return !(dot3(first_normal, normal) < kSameCluster);
}

// Returns the cluster started by a plane, extended by it, or unchanged. (Without branches: software drivers run both
// sides of each.)
BURIN_FN Cluster cluster_with(Cluster old, bool opened, bool joined, Float3 normal, float offset) {
    BURIN_PRECISE Float3 more_normal = old.normal_sum + normal;
    BURIN_PRECISE float more_offset = old.offset_sum + offset;
    Cluster now;
    now.first_normal = opened ? normal : old.first_normal;
    now.normal_sum = opened ? normal : (joined ? more_normal : old.normal_sum);
    now.offset_sum = opened ? offset : (joined ? more_offset : old.offset_sum);
    now.count = opened ? 1.0f : (joined ? old.count + 1.0f : old.count);
    return now;
}

BURIN_HOT_FN Float3 mean_normal(Float3 normal_sum, float length) {
    BURIN_PRECISE Float3 mean = exact_quotient(normal_sum, length);
    return mean;
}
BURIN_HOT_FN float mean_offset(float offset_sum, float count) {
    BURIN_PRECISE float mean = exact_quotient(offset_sum, count);
    return mean;
}

// Returns the offset from the mean position towards one plane.
BURIN_HOT_FN Float3 offset_to_plane(Float3 normal, float offset) {
    BURIN_PRECISE Float3 way = normal * (kTowardsTangents * offset);
    return way;
}
BURIN_FN float squared_sine(float cosine) {
    BURIN_PRECISE float sine2 = 1.0f - cosine * cosine;
    return sine2;
}
// Returns the offset to the nearest point of the line in which two planes meet; sine2 is the squared sine of their
// angle.
BURIN_FN Float3 offset_to_line(Float3 n0, float d0, Float3 n1, float d1, float cosine, float sine2) {
    BURIN_PRECISE Float3 way = exact_quotient(n0 * (d0 - cosine * d1) + n1 * (d1 - cosine * d0), sine2);
    return way;
}
// Returns the offset to the point in which three planes meet; `across` is the cross product of n1 and n2, `volume` the
// triple product of all three.
BURIN_FN Float3 offset_to_corner(Float3 n0, float d0, Float3 n1, float d1, Float3 n2, float d2, Float3 across,
                                 float volume) {
    BURIN_PRECISE Float3 way = exact_quotient(across * d0 + cross3(n2, n0) * d1 + cross3(n0, n1) * d2, volume);
    return way;
}

// Returns a vertex's position, clamped to at most kOutside beyond its cell.
BURIN_HOT_FN Float3 place_from_mean(Float3 mean, Float3 offset) {
    BURIN_PRECISE Float3 place = mean + offset;
    return clamped(place, -kOutside, 1.0f + kOutside);
}

BURIN_SHARED_END
#endif
