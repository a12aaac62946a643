// SPDX-License-Identifier: MIT
#include "geometry/mesh/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace burin::geometry {
namespace {

using Corners = std::vector<std::uint32_t>;

// Returns twice the vector area (Newell 1972), about the first corner so that distant polygons keep their precision.
Vec3 vector_area(std::span<const Vec3> p) {
    Vec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += glm::cross(p[i] - p[0], p[i + 1] - p[0]);
    return sum;
}

// Projects the corners onto the mean plane, counter-clockwise; nothing when the polygon has no mean plane.
std::optional<std::vector<Vec2>> flattened(std::span<const Vec3> p) {
    const Vec3 area = vector_area(p);
    const double length = glm::length(area);
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    const Vec3 n = area / length;
    const Vec3 aside = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(glm::cross(aside, n));
    const Vec3 v = glm::cross(n, u);
    std::vector<Vec2> flat;
    flat.reserve(p.size());
    for (const Vec3& corner : p) flat.emplace_back(glm::dot(corner - p[0], u), glm::dot(corner - p[0], v));
    return flat;
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Tells whether every corner turns left and the directions go round once: a polygon that winds twice is not convex.
bool convex(const std::vector<Vec2>& p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0.0) return false;
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
        if (turn(p[0], p[i], p[i + 1]) < 0.0) return false;
    }
    return true;
}

bool inside(const Vec2& q, const Vec2& a, const Vec2& b, const Vec2& c) {
    return turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 && turn(c, a, q) >= 0.0;
}

bool is_ear(const std::vector<Vec2>& p, const Corners& left, std::size_t i) {
    const std::size_t n = left.size();
    const Vec2 &a = p[left[(i + n - 1) % n]], &b = p[left[i]], &c = p[left[(i + 1) % n]];
    if (turn(a, b, c) <= 0.0) return false;
    return std::ranges::none_of(left, [&](std::uint32_t k) {
        const Vec2& q = p[k];
        return q != a && q != b && q != c && inside(q, a, b, c);
    });
}

// Cuts ears one after another; nothing when no ear is left among more than three corners.
std::optional<std::vector<std::array<std::uint32_t, 3>>> cut_ears(const std::vector<Vec2>& p) {
    Corners left(p.size());
    std::iota(left.begin(), left.end(), 0u);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    // Continues where the last ear was: cutting in turns keeps the triangles well shaped.
    std::size_t next = 0;
    // A simple polygon needs about two tests a corner; a crossed one could need n * n.
    std::size_t tests = 8 * p.size();
    while (left.size() > 3) {
        const std::size_t n = left.size();
        std::size_t tried = 0;
        while (tried < n && tests > 0 && !is_ear(p, left, (next + tried) % n)) ++tried, --tests;
        if (tried == n || tests == 0) return std::nullopt;
        const std::size_t ear = (next + tried) % n;
        triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
        next = (ear + 1) % left.size();
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

std::vector<std::array<std::uint32_t, 3>> fan(std::size_t corners) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(corners - 2);
    for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
    return triangles;
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

SplitPolygon split_polygon(std::span<const Vec3> corners_m, std::size_t max_ear_corners) {
    if (corners_m.size() == 3) return {PolygonSplit::fan, {{0, 1, 2}}};
    const auto flat = flattened(corners_m);
    if (!flat) return {PolygonSplit::blind_fan, fan(corners_m.size())};
    if (convex(*flat)) return {PolygonSplit::fan, fan(corners_m.size())};
    if (corners_m.size() <= max_ear_corners) {
        if (auto ears = cut_ears(*flat)) return {PolygonSplit::ears, std::move(*ears)};
    }
    return {PolygonSplit::blind_fan, fan(corners_m.size())};
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
