// SPDX-License-Identifier: MIT
#include "tests/tools/topology.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mesh_audit {

namespace {

// One side of a triangle: its two vertices, lower first, and where it comes from.
struct Side {
    std::uint64_t key = 0;     // lower vertex in the upper half
    std::uint32_t corner = 0;  // 3 * triangle + the corner at which the side starts

    [[nodiscard]] std::uint32_t triangle() const { return corner / 3; }
};

std::uint32_t next_in_triangle(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }
    bool is_representative(std::uint32_t i) { return parent_[i] == i; }

private:
    std::vector<std::uint32_t> parent_;
};

bool repeats_a_corner(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

bool is_finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Point minus(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

std::vector<Side> sorted_sides(const std::vector<Triangle>& triangles) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (repeats_a_corner(triangles[t])) continue;
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint64_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
            sides.push_back({std::min(a, b) << 32 | std::max(a, b), 3 * t + c});
        }
    }
    std::ranges::sort(sides, {}, &Side::key);
    return sides;
}

void measure(const Mesh& mesh, const std::vector<bool>& used, Audit& result) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    Point lo{kFar, kFar, kFar}, hi{-kFar, -kFar, -kFar};
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const Point& p = mesh.points[i];
        if (!is_finite(p)) ++result.nonfinite_vertices;
        if (!used[i] || !is_finite(p)) continue;
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
    }
    result.lo = lo;
    result.hi = hi;
    // Seen from the middle of the box the terms are small, so little is lost by cancellation.
    const Point middle{0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y), 0.5 * (lo.z + hi.z)};
    for (const Triangle& t : mesh.triangles) {
        const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        if (!is_finite(a) || !is_finite(b) || !is_finite(c)) continue;
        const Point normal = cross(minus(b, a), minus(c, a));
        const double doubled_area = std::sqrt(dot(normal, normal));
        if (doubled_area == 0 && !repeats_a_corner(t)) ++result.zero_area_triangles;
        result.area += 0.5 * doubled_area;
        result.volume += dot(minus(a, middle), normal) / 6.0;
    }
}

// Judges each edge, and joins the triangles (for components) and the corners (for fans) on its two sides.
void walk_edges(const Mesh& mesh, const std::vector<Side>& sides, Sets& triangles, Sets& corners,
                std::vector<bool>& at_bad_edge, Audit& result) {
    const auto vertex = [&](std::uint32_t corner) { return mesh.triangles[corner / 3][corner % 3]; };
    for (std::size_t from = 0, to = 0; from < sides.size(); from = to) {
        while (to < sides.size() && sides[to].key == sides[from].key) ++to;
        ++result.edges;
        for (std::size_t i = from + 1; i < to; ++i) triangles.unite(sides[from].triangle(), sides[i].triangle());
        const std::uint32_t first = sides[from].corner;
        if (to - from == 1) {
            ++result.open_edges;
        } else if (to - from > 2) {
            ++result.nonmanifold_edges;
            at_bad_edge[vertex(first)] = at_bad_edge[vertex(next_in_triangle(first))] = true;
        } else {
            const std::uint32_t second = sides[from + 1].corner;
            const bool same_direction = vertex(first) == vertex(second);
            if (same_direction) ++result.misoriented_edges;
            corners.unite(first, same_direction ? second : next_in_triangle(second));
            corners.unite(next_in_triangle(first), same_direction ? next_in_triangle(second) : second);
        }
    }
}

void count_vertices(const Mesh& mesh, Sets& corners, const std::vector<bool>& at_bad_edge, Audit& result) {
    std::vector<std::uint32_t> fans(mesh.points.size(), 0);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (repeats_a_corner(mesh.triangles[t])) continue;
        for (std::uint32_t c = 0; c < 3; ++c) {
            if (corners.is_representative(3 * t + c)) ++fans[mesh.triangles[t][c]];
        }
    }
    for (std::size_t i = 0; i < fans.size(); ++i) {
        if (fans[i] > 0) ++result.vertices;
        if (fans[i] > 1 || at_bad_edge[i]) ++result.nonmanifold_vertices;
    }
    result.unused_vertices = mesh.points.size() - result.vertices;
}

}  // namespace

Audit audit(const Mesh& mesh) {
    Audit result;
    result.triangles = mesh.triangles.size();
    std::vector<bool> used(mesh.points.size(), false), at_bad_edge(mesh.points.size(), false);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) used[v] = true;
        if (repeats_a_corner(t)) ++result.repeated_corners;
    }
    measure(mesh, used, result);

    const std::vector<Side> sides = sorted_sides(mesh.triangles);
    Sets triangles(mesh.triangles.size()), corners(3 * mesh.triangles.size());
    walk_edges(mesh, sides, triangles, corners, at_bad_edge, result);
    count_vertices(mesh, corners, at_bad_edge, result);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!repeats_a_corner(mesh.triangles[t]) && triangles.is_representative(t)) ++result.components;
    }
    const auto faces = static_cast<std::int64_t>(result.triangles - result.repeated_corners);
    result.euler_characteristic =
        static_cast<std::int64_t>(result.vertices) - static_cast<std::int64_t>(result.edges) + faces;
    if (result.closed_and_oriented() && result.nonmanifold_vertices == 0) {
        result.genus = static_cast<std::int64_t>(result.components) - result.euler_characteristic / 2;
    }
    return result;
}

}  // namespace mesh_audit
