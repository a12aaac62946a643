// SPDX-License-Identifier: MIT
#include "geometry/mesh/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/mesh/exact_sign.hpp"
#include "geometry/mesh/flat_polygon.hpp"

namespace burin::geometry {
namespace {

// What the vector area must at least be of the areas that it sums up to say how a polygon lies. Less is left where
// the loops of a figure of eight cancel.
constexpr double kLeastVectorArea = 1e-6;

// Where a polygon lies, from its triangles about corner 0, so that distant polygons keep their precision.
struct PolygonPlane {
    Vec3 normal{0.0};     // twice the vector area
    Vec3 absolute{0.0};   // the same sums without signs
    int axis = 0;         // along which the polygon is seen largest

    [[nodiscard]] bool has_area() const { return absolute[axis] > 0.0; }
};

int largest_axis(const Vec3& v) { return v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2; }

PolygonPlane plane_of(std::span<const Vec3> p) {
    PolygonPlane o;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        const Vec3 area = glm::cross(p[i] - p[0], p[i + 1] - p[0]);
        o.normal += area;
        o.absolute += glm::abs(area);
    }
    const Vec3 size = glm::abs(o.normal);
    o.axis = largest_axis(size);
    if (size[o.axis] < kLeastVectorArea * o.absolute[largest_axis(o.absolute)]) o.axis = largest_axis(o.absolute);
    return o;
}

// Returns the corners as seen along the axis, against the normal; no coordinate is rounded.
std::vector<Vec2> seen_along_axis(std::span<const Vec3> p, const PolygonPlane& o) {
    const int right = (o.axis + 1) % 3, up = (o.axis + 2) % 3;
    const double sign = o.normal[o.axis] < 0.0 ? -1.0 : 1.0;
    std::vector<Vec2> flat;
    flat.reserve(p.size());
    for (const Vec3& corner : p) flat.emplace_back(corner[right], sign * corner[up]);
    return flat;
}

// Returns the corners projected onto the mean plane, in rounded numbers.
std::vector<Vec2> in_mean_plane(std::span<const Vec3> p, const PolygonPlane& o) {
    const Vec3 n = glm::normalize(o.normal);
    const Vec3 aside = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(glm::cross(aside, n)), v = glm::cross(n, u);
    std::vector<Vec2> flat;
    flat.reserve(p.size());
    for (const Vec3& corner : p) flat.emplace_back(glm::dot(corner - p[0], u), glm::dot(corner - p[0], v));
    return flat;
}

bool comes_first(const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Tells whether every corner turns left and the polygon goes to the right and back once; one that winds twice goes
// there twice.
bool convex(std::span<const Vec2> p) {
    const std::size_t n = p.size();
    std::size_t rightmost = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
        if (turn_in_plane(a, b, c) <= 0) return false;
        if (comes_first(a, b) && comes_first(c, b)) ++rightmost;
    }
    return rightmost == 1;
}

std::vector<CornerTriple> fan(std::size_t corners) {
    std::vector<CornerTriple> triangles;
    triangles.reserve(corners - 2);
    for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
    return triangles;
}

// Splits a polygon no corner of which repeats the place of the one before.
SplitPolygon split_distinct(std::span<const Vec3> p) {
    if (p.size() == 3) return {PolygonSplit::fan, fan(3)};
    const PolygonPlane o = plane_of(p);
    if (!o.has_area()) return {PolygonSplit::crossing, fan(p.size())};
    const std::vector<Vec2> seen = seen_along_axis(p, o);
    if (convex(seen)) return {PolygonSplit::fan, fan(p.size())};
    SweptPolygon swept = sweep_polygon(seen);
    if (swept.contact == SelfContact::none) return {PolygonSplit::sweep, std::move(swept.triangles)};
    if (glm::length(o.normal) > 0.0) {
        SweptPolygon flat = sweep_polygon(in_mean_plane(p, o));
        if (flat.contact == SelfContact::none) return {PolygonSplit::sweep, std::move(flat.triangles)};
    }
    if (!swept.triangles.empty()) return {PolygonSplit::touching, std::move(swept.triangles)};
    ClippedPolygon clipped = clip_ears(seen);
    const bool crosses = clipped.folded || swept.contact == SelfContact::cross;
    return {crosses ? PolygonSplit::crossing : PolygonSplit::touching, std::move(clipped.triangles)};
}

// Adds the triangles of the corners that were left out: each hangs on the edge that leads on from the corner that it
// repeats.
void add_repeats(std::size_t corners, const std::vector<std::uint32_t>& kept, SplitPolygon& split) {
    for (CornerTriple& t : split.triangles) {
        for (std::uint32_t& corner : t) corner = kept[corner];
    }
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const std::uint32_t onward = kept[(i + 1) % kept.size()], n = static_cast<std::uint32_t>(corners);
        for (std::uint32_t k = kept[i]; (k + 1) % n != onward; k = (k + 1) % n)
            split.triangles.push_back({k, (k + 1) % n, onward});
    }
}

constexpr double kImpossible = std::numeric_limits<double>::infinity();

struct Best {
    // Area of the triangulated part of the loop between two corners, closed by the diagonal between them.
    double area_m2 = 0.0;
    std::uint32_t apex = 0;  // apex of the triangle on that diagonal
};

class Table {
public:
    explicit Table(std::size_t n) : n_(n), best_(n * n) {}
    Best& operator()(std::size_t i, std::size_t j) { return best_[i * n_ + j]; }

private:
    std::size_t n_;
    std::vector<Best> best_;
};

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::length(glm::cross(b - a, c - a)) / 2.0; }

}  // namespace

SplitPolygon split_polygon(std::span<const Vec3> corners_m) {
    const std::size_t n = corners_m.size();
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < n; ++i) {
        if (corners_m[i] != corners_m[i == 0 ? n - 1 : i - 1]) kept.push_back(i);
    }
    if (kept.size() == n) return split_distinct(corners_m);
    if (kept.size() < 3) return {n == 3 ? PolygonSplit::fan : PolygonSplit::crossing, fan(n)};
    std::vector<Vec3> distinct;
    for (const std::uint32_t i : kept) distinct.push_back(corners_m[i]);
    SplitPolygon split = split_distinct(distinct);
    add_repeats(n, kept, split);
    return split;
}

std::optional<std::vector<std::array<std::uint32_t, 3>>> least_area_triangulation(
    std::span<const Vec3> loop_m, const std::function<bool(std::size_t, std::size_t)>& allowed) {
    const std::size_t n = loop_m.size();
    Table best(n);
    for (std::size_t span = 2; span < n; ++span) {
        for (std::size_t i = 0; i + span < n; ++i) {
            const std::size_t j = i + span;
            Best& here = best(i, j);
            here.area_m2 = kImpossible;
            if (span + 1 < n && !allowed(i, j)) continue;  // (0, n - 1) is an edge of the loop
            for (std::size_t k = i + 1; k < j; ++k) {
                const double sum = best(i, k).area_m2 + best(k, j).area_m2 + area(loop_m[i], loop_m[k], loop_m[j]);
                if (sum < here.area_m2) here = {sum, static_cast<std::uint32_t>(k)};
            }
        }
    }
    if (best(0, n - 1).area_m2 == kImpossible) return std::nullopt;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> open{{0, static_cast<std::uint32_t>(n - 1)}};
    while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        if (j - i < 2) continue;
        const std::uint32_t k = best(i, j).apex;
        triangles.push_back({i, k, j});
        open.push_back({i, k});
        open.push_back({k, j});
    }
    return triangles;
}

}  // namespace burin::geometry
