// SPDX-License-Identifier: MIT
#include "geometry/mesh/triangle_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/mesh/exact_sign.hpp"

namespace burin::geometry {
namespace {

struct Segment {
    const Vec3 &from, &to;
};

bool boxes_meet(const Segment& s, const Segment& t) {
    for (int k = 0; k < 3; ++k) {
        if (std::max(s.from[k], s.to[k]) < std::min(t.from[k], t.to[k])) return false;
        if (std::max(t.from[k], t.to[k]) < std::min(s.from[k], s.to[k])) return false;
    }
    return true;
}

// Requires a point on the segment's line.
bool within_ends(const Vec3& p, const Segment& s) { return boxes_meet({p, p}, s); }

// Requires segments in one plane that is not seen edge-on along the axis.
bool meet_in_plane(int axis, const Segment& s, const Segment& t) {
    const int t_from = turn_seen_along(axis, s.from, s.to, t.from), t_to = turn_seen_along(axis, s.from, s.to, t.to);
    const int s_from = turn_seen_along(axis, t.from, t.to, s.from), s_to = turn_seen_along(axis, t.from, t.to, s.to);
    if (t_from == 0 && within_ends(t.from, s)) return true;
    if (t_to == 0 && within_ends(t.to, s)) return true;
    if (s_from == 0 && within_ends(s.from, t)) return true;
    if (s_to == 0 && within_ends(s.to, t)) return true;
    return t_from * t_to < 0 && s_from * s_to < 0;
}

bool segments_meet(const Segment& s, const Segment& t) {
    if (!boxes_meet(s, t)) return false;
    if (side_of_plane(s.from, s.to, t.from, t.to) != 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const bool seen_flat = turn_seen_along(axis, s.from, s.to, t.from) == 0 &&
                               turn_seen_along(axis, s.from, s.to, t.to) == 0 &&
                               turn_seen_along(axis, t.from, t.to, s.from) == 0;
        if (!seen_flat) return meet_in_plane(axis, s, t);
    }
    return true;  // on one line, and the boxes meet
}

using Corners = std::array<Vec3, 3>;

bool meets_an_edge(const Segment& s, const Corners& t) {
    return segments_meet(s, {t[0], t[1]}) || segments_meet(s, {t[1], t[2]}) || segments_meet(s, {t[2], t[0]});
}

// Requires a point in the triangle's plane; `turn` is the triangle's own turn along the axis, not 0.
bool inside_in_plane(int axis, int turn, const Vec3& p, const Corners& t) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (turn_seen_along(axis, t[k], t[(k + 1) % 3], p) * turn < 0) return false;
    }
    return true;
}

bool segment_meets(const Segment& s, const Corners& t) {
    const int from = side_of_plane(t[0], t[1], t[2], s.from), to = side_of_plane(t[0], t[1], t[2], s.to);
    if (from * to > 0) return false;
    if (from == 0 && to == 0) {  // in the triangle's plane, or the triangle has no area
        for (int axis = 0; axis < 3; ++axis) {
            const int turn = turn_seen_along(axis, t[0], t[1], t[2]);
            if (turn != 0) return inside_in_plane(axis, turn, s.from, t) || meets_an_edge(s, t);
        }
        return meets_an_edge(s, t);
    }
    // The segment misses the triangle when its line passes edges on both sides; otherwise it passes inside or meets an
    // edge.
    bool left = false, right = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const int side = side_of_plane(s.from, s.to, t[k], t[(k + 1) % 3]);
        left = left || side > 0;
        right = right || side < 0;
    }
    return !(left && right);
}

bool all_strictly_on_one_side(const Corners& plane, const Corners& t) {
    const int first = side_of_plane(plane[0], plane[1], plane[2], t[0]);
    return first != 0 && side_of_plane(plane[0], plane[1], plane[2], t[1]) == first &&
           side_of_plane(plane[0], plane[1], plane[2], t[2]) == first;
}

// Tells whether a plane perpendicular to the line between the centroids separates the triangles beyond doubt. As
// parted_at does, this avoids exact arithmetic for neighbours in one plane.
bool parted(const Corners& first, const Corners& second) {
    const Vec3& origin = first[0];
    const Vec3 across = (second[0] - origin) + (second[1] - first[1]) + (second[2] - first[2]);
    double top = -std::numeric_limits<double>::infinity(), bottom = -top, size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = first[k] - origin, b = second[k] - origin;
        top = std::max(top, glm::dot(a, across));
        bottom = std::min(bottom, glm::dot(b, across));
        size = std::max({size, glm::dot(a, a), glm::dot(b, b)});
    }
    // The limit is ten times the rounding of the differences and the dot products; false for NaN.
    return bottom - top > 1e-14 * std::sqrt(size * glm::dot(across, across));
}

// Tells whether a plane through the shared point, midway between the triangles, separates a, b from c, d beyond doubt.
bool parted_at(const Vec3& shared, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 to_a = a - shared, to_b = b - shared, to_c = c - shared, to_d = d - shared;
    const auto unit = [](const Vec3& v) { return v / std::sqrt(glm::dot(v, v)); };
    const Vec3 across = unit(unit(to_a) + unit(to_b)) - unit(unit(to_c) + unit(to_d));
    // The limit is ten times the rounding of a difference and of a dot product with a vector of length 2 at most; false
    // for NaN.
    const auto clear = [&](const Vec3& v, double side) {
        return side * glm::dot(v, across) > 1e-14 * (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
    };
    return clear(to_a, 1.0) && clear(to_b, 1.0) && clear(to_c, -1.0) && clear(to_d, -1.0);
}

// Tests triangles that share one vertex, `apex`: a further common point can be followed away from the apex until one of
// the triangles ends.
bool meet_beyond_vertex(const Vec3& apex, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    if (parted_at(apex, a, b, c, d)) return false;
    return segment_meets({a, b}, {apex, c, d}) || segment_meets({c, d}, {apex, a, b});
}

// Tests triangles that share the edge u, v: they meet beyond it only in one plane, on the same side of the edge.
bool meet_beyond_edge(const Vec3& u, const Vec3& v, const Vec3& a, const Vec3& b) {
    // Rules out triangles clearly on opposite sides: the heights over the edge point away from each other.
    const Vec3 edge = v - u, to_a = a - u, to_b = b - u;
    const Vec3 up_a = glm::cross(edge, to_a), up_b = glm::cross(edge, to_b);
    const double a2 = glm::dot(up_a, up_a), b2 = glm::dot(up_b, up_b), edge2 = glm::dot(edge, edge);
    const double facing = glm::dot(up_a, up_b);
    const bool both_have_area = a2 > 1e-20 * edge2 * glm::dot(to_a, to_a) && b2 > 1e-20 * edge2 * glm::dot(to_b, to_b);
    if (both_have_area && facing < 0.0 && facing * facing > 1e-6 * a2 * b2) return false;
    if (side_of_plane(u, v, a, b) != 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const int turn_a = turn_seen_along(axis, u, v, a), turn_b = turn_seen_along(axis, u, v, b);
        if (turn_a != 0 || turn_b != 0) return turn_a * turn_b > 0;
    }
    // All on one line: they meet where they overlap beyond the edge at either end.
    const auto both_beyond = [&](const Vec3& end, const Vec3& other) {
        return within_ends(end, {other, a}) && within_ends(end, {other, b}) && a != end && b != end;
    };
    return both_beyond(v, u) || both_beyond(u, v);
}

struct Sharing {
    std::size_t count = 0;
    std::array<std::size_t, 3> in_first{}, in_second{};
};

Sharing shared_vertices(const VertexTriple& first, const VertexTriple& second) {
    Sharing sharing;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (first[i] != second[j]) continue;
            sharing.in_first[sharing.count] = i;
            sharing.in_second[sharing.count++] = j;
        }
    }
    return sharing;
}

}  // namespace

bool triangles_meet(const std::array<Vec3, 3>& first, const std::array<Vec3, 3>& second) {
    if (parted(first, second)) return false;
    if (all_strictly_on_one_side(first, second) || all_strictly_on_one_side(second, first)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
        if (segment_meets({first[k], first[(k + 1) % 3]}, second)) return true;
        if (segment_meets({second[k], second[(k + 1) % 3]}, first)) return true;
    }
    return false;
}

bool meet_beyond_shared(std::span<const Vec3> positions, const VertexTriple& first, const VertexTriple& second) {
    const Sharing s = shared_vertices(first, second);
    const auto one = [&](std::size_t k) -> const Vec3& { return positions[first[k % 3]]; };
    const auto two = [&](std::size_t k) -> const Vec3& { return positions[second[k % 3]]; };
    const std::size_t i = s.in_first[0], j = s.in_second[0];
    if (s.count == 0) return triangles_meet({one(0), one(1), one(2)}, {two(0), two(1), two(2)});
    if (s.count == 1) return meet_beyond_vertex(one(i), one(i + 1), one(i + 2), two(j + 1), two(j + 2));
    if (s.count == 3) return true;
    return meet_beyond_edge(one(i), one(s.in_first[1]), one(3 - i - s.in_first[1]), two(3 - j - s.in_second[1]));
}

}  // namespace burin::geometry
