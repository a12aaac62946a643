// SPDX-License-Identifier: MIT
#include "geometry/mesh/triangle_tree.hpp"

#include <algorithm>
#include <cmath>

namespace burin::geometry {
namespace {

// Rounds one float further outwards than the conversion may have rounded inwards.
float outwards(double x, float towards) { return std::nextafter(static_cast<float>(x), towards); }

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Spreads the low 21 bits to every third bit.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x1f00000000ffffULL;
    x = (x | x << 16) & 0x1f0000ff0000ffULL;
    x = (x | x << 8) & 0x100f00f00f00f00fULL;
    x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
    return (x | x << 2) & 0x1249249249249249ULL;
}

std::uint64_t morton(const Vec3& p, const Vec3& lo, double steps_a_metre) {
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) {
        const double step = std::clamp((p[k] - lo[k]) * steps_a_metre, 0.0, double{0x1fffff});
        code |= spread(static_cast<std::uint64_t>(step)) << k;
    }
    return code;
}

float squared_distance(const TreeBox& box, const Vec3f& p) {
    const Vec3f out = glm::max(glm::max(box.lo - p, p - box.hi), Vec3f(0.0f));
    return glm::dot(out, out);
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Vec3> positions, std::span<const VertexTriple> triangles)
    : positions_(positions), triangles_(triangles) {
    Box all;
    for (const VertexTriple& t : triangles) {
        for (const std::uint32_t v : t) all.include(positions[v]);
    }
    if (all.empty()) return;
    middle_m_ = all.center();
    const Vec3 extent = all.extent();
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double steps_a_metre = longest > 0.0 ? 0x1fffff / longest : 0.0;

    struct Coded {
        std::uint64_t code;
        std::uint32_t triangle;
    };
    std::vector<Coded> coded;
    coded.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (names_a_vertex_twice(triangles[t])) continue;
        const auto [a, b, c] = triangles[t];
        coded.push_back({morton((positions[a] + positions[b] + positions[c]) / 3.0, all.lo, steps_a_metre), t});
    }
    std::ranges::sort(coded, [](const Coded& a, const Coded& b) {
        return a.code != b.code ? a.code < b.code : a.triangle < b.triangle;
    });
    order_.reserve(coded.size());
    boxes_.reserve(coded.size());
    for (const Coded& c : coded) {
        Box box;
        for (const std::uint32_t v : triangles[c.triangle]) box.include(positions[v]);
        order_.push_back(c.triangle);
        boxes_.push_back(box_of(box));
    }
    for (const std::vector<TreeBox>* below = &boxes_; below == &boxes_ || below->size() > 1;) {
        std::vector<TreeBox> level((below->size() + kBranches - 1) / kBranches);
        for (std::size_t i = 0; i < below->size(); ++i) level[i / kBranches].include((*below)[i]);
        if (level.empty()) return;
        levels_.push_back(std::move(level));
        below = &levels_.back();
    }
}

TreeBox TriangleTree::box_of(const Box& box_m) const {
    TreeBox box;
    for (int k = 0; k < 3; ++k) {
        box.lo[k] = outwards(box_m.lo[k] - middle_m_[k], -kInfinity);
        box.hi[k] = outwards(box_m.hi[k] - middle_m_[k], kInfinity);
    }
    return box;
}

void TriangleTree::try_triangle(std::uint32_t triangle, const Vec3& point_m, Near& near) const {
    const auto [a, b, c] = triangles_[triangle];
    const Vec3 gap = nearest_point({positions_[a], positions_[b], positions_[c]}, point_m) - point_m;
    const double distance = std::sqrt(glm::dot(gap, gap));
    if (distance < near.distance_m) near = {distance, triangle};
}

TriangleTree::Near TriangleTree::nearest(const Vec3& point_m, std::uint32_t hint, double good_enough_m) const {
    Near near;
    if (levels_.empty()) return near;
    if (hint < triangles_.size() && !names_a_vertex_twice(triangles_[hint])) try_triangle(hint, point_m, near);
    if (near.distance_m > good_enough_m) {
        search(levels_.size() - 1, 0, point_m, Vec3f(point_m - middle_m_), good_enough_m, near);
    }
    return near;
}

void TriangleTree::search(std::size_t level, std::size_t node, const Vec3& point, const Vec3f& place,
                          double good_enough_m, Near& near) const {
    const std::size_t first = node * kBranches;
    const std::vector<TreeBox>& below = level == 0 ? boxes_ : levels_[level - 1];
    const std::size_t count = std::min(first + kBranches, below.size()) - first;
    std::array<std::pair<float, std::size_t>, kBranches> children;
    for (std::size_t i = 0; i < count; ++i) children[i] = {squared_distance(below[first + i], place), first + i};
    std::sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
        // The box's distance is a float; subtracts a share for its rounding, so that no nearer triangle is missed.
        const double within = std::sqrt(static_cast<double>(children[i].first)) * (1.0 - 1e-5) -
                              1e-6 * std::sqrt(static_cast<double>(glm::dot(place, place)));
        if (within >= near.distance_m || near.distance_m <= good_enough_m) return;
        if (level == 0) {
            try_triangle(order_[children[i].second], point, near);
        } else {
            search(level - 1, children[i].second, point, place, good_enough_m, near);
        }
    }
}

// Source: Ericson, Real-Time Collision Detection, 5.1.5: by the Voronoi regions of the corners, the edges and the face.
Vec3 nearest_point(const std::array<Vec3, 3>& triangle, const Vec3& p) {
    const auto& [a, b, c] = triangle;
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double whole = 1.0 / (va + vb + vc);
    return a + ab * (vb * whole) + ac * (vc * whole);
}

}  // namespace burin::geometry
