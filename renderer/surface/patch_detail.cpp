// SPDX-License-Identifier: MIT
#include "renderer/surface/patch_detail.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <meshoptimizer.h>

#include "base/space.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::renderer {
namespace {

using shared::SurfaceVertex;

// Largest displacement of the surface for each level, in edge
// lengths. A level is drawn where that is a fraction of a pixel.
constexpr std::array<double, 7> kErrors{0.01, 0.02, 0.03, 0.05, 0.08, 0.15, 0.5};
constexpr double kWorthIt = 0.85;  // share of the previous level's triangles: a level with more is discarded

// Largest change of a vertex: 8 steps of 255 in light or colour,
// and a turn of the normal that changes the light on it as much.
constexpr double kMostChange = 8.0 / 255.0;
constexpr double kMostTurn = 0.06;  // |difference of unit normals|

struct Look {
    Vec3 normal, colour;
    double sun, open;
};

Look look_of(const SurfaceVertex& v, geometry::VertexLight light) {
    const shared::Direction n = shared::decode_normal(v.normal);
    const auto byte = [](std::uint32_t word, int shift) {
        return static_cast<double>((word >> shift) & 0xffu) / 255.0;
    };
    return {{n.x, n.y, n.z},
            {byte(v.colour, 0), byte(v.colour, 8), byte(v.colour, 16)},
            light.sun / 255.0,
            light.open / 255.0};
}

bool close(const Look& a, const Look& b) {
    const Vec3 colour = glm::abs(a.colour - b.colour);
    return std::max({colour.x, colour.y, colour.z, std::abs(a.sun - b.sun), std::abs(a.open - b.open)}) <=
               kMostChange &&
           glm::length(a.normal - b.normal) <= kMostTurn;
}

Vec3 place(const SurfaceVertex& v) { return {v.x, v.y, v.z}; }

// Largest changes along an edge of a smooth triangle. Interpolation of light over an angle is off by an eighth of the
// angle's square: less than 1 of 255.
constexpr double kSmoothTurn = 0.12;
constexpr double kSmoothChange = 24.0 / 255.0;

struct Foot {
    double distance = 1e30;
    std::size_t triangle = 0;  // index of its first index
    Vec3 weights{0.0};         // of its three corners
};

// Returns the barycentric coordinates of the triangle's point
// nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const Vec3 bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    const Vec3 cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - w, w};
    }
    const double scale = 1.0 / (va + vb + vc);
    return {1 - (vb + vc) * scale, vb * scale, vc * scale};
}

// A triangle of a coarser level, prepared for nearest-point queries from many vertices.
struct Corners {
    Vec3 a, b, c, normal;
    Box box;
};

// Returns whether the triangle's box is farther than `distance`; no point on the triangle is nearer than its box.
bool surely_farther(const Box& box, const Vec3& p, double distance) {
    const Vec3 away = p - glm::clamp(p, box.lo, box.hi);
    constexpr double kRounding = 1.0 + 1e-9;
    return glm::dot(away, away) > kRounding * distance * distance;
}

// Checks the coarser levels of one patch.
class Judge {
public:
    Judge(std::span<const SurfaceVertex> vertices, std::span<const std::uint32_t> indices,
          std::span<const geometry::VertexLight> light)
        : vertices_(vertices), used_(vertices.size(), false) {
        looks_.reserve(vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i)
            looks_.push_back(look_of(vertices[i], i < light.size() ? light[i] : geometry::VertexLight{}));
        for (const std::uint32_t i : indices) used_[i] = true;
    }

    // Returns the distance of the farthest vertex from the coarser level; HUGE_VAL if one of them would look different.
    [[nodiscard]] double deviation(std::span<const std::uint32_t> coarse) const {
        std::vector<bool> kept(vertices_.size(), false);
        for (const std::uint32_t i : coarse) kept[i] = true;
        double worst = 0.0;
        const std::vector<Corners> triangles = corners_of(coarse);
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (!used_[i] || kept[i]) continue;
            const Foot foot = foot_of(i, triangles);
            if (!close(looks_[i], look_at(foot, coarse))) return HUGE_VAL;
            worst = std::max(worst, foot.distance);
        }
        return worst;
    }

private:
    [[nodiscard]] std::vector<Corners> corners_of(std::span<const std::uint32_t> coarse) const {
        std::vector<Corners> triangles;
        triangles.reserve(coarse.size() / 3);
        for (std::size_t t = 0; t + 2 < coarse.size(); t += 3) {
            const Vec3 a = place(vertices_[coarse[t]]), b = place(vertices_[coarse[t + 1]]),
                       c = place(vertices_[coarse[t + 2]]);
            triangles.push_back(
                {a, b, c, glm::cross(b - a, c - a), {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))}});
        }
        return triangles;
    }

    // Returns the nearest point on a coarse triangle that faces
    // as the vertex does: beyond a sharp edge lies another face.
    [[nodiscard]] Foot foot_of(std::size_t vertex, std::span<const Corners> triangles) const {
        const Vec3 p = place(vertices_[vertex]);
        Foot best;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const Corners& at = triangles[t];
            if (surely_farther(at.box, p, best.distance) || glm::dot(at.normal, looks_[vertex].normal) <= 0.0) continue;
            const Vec3 w = nearest_weights(p, at.a, at.b, at.c);
            const double distance = glm::length(w.x * at.a + w.y * at.b + w.z * at.c - p);
            if (distance < best.distance) best = {distance, 3 * t, w};
        }
        return best;
    }

    [[nodiscard]] Look look_at(const Foot& foot, std::span<const std::uint32_t> coarse) const {
        Look sum{Vec3(0.0), Vec3(0.0), 0.0, 0.0};
        for (int k = 0; k < 3; ++k) {
            const Look& corner = looks_[coarse[foot.triangle + static_cast<std::size_t>(k)]];
            sum.normal += foot.weights[k] * corner.normal;
            sum.colour += foot.weights[k] * corner.colour;
            sum.sun += foot.weights[k] * corner.sun;
            sum.open += foot.weights[k] * corner.open;
        }
        const double length = glm::length(sum.normal);
        if (length > 0.0) sum.normal /= length;
        return sum;
    }

    std::span<const SurfaceVertex> vertices_;
    std::vector<bool> used_;
    std::vector<Look> looks_;
};

bool differ_little(const Look& a, const Look& b) {
    const Vec3 turn = a.normal - b.normal, colour = glm::abs(a.colour - b.colour);
    return glm::dot(turn, turn) <= kSmoothTurn * kSmoothTurn &&
           std::max({colour.x, colour.y, colour.z, std::abs(a.sun - b.sun), std::abs(a.open - b.open)}) <=
               kSmoothChange;
}

}  // namespace

SmoothFirst smooth_first(std::span<const SurfaceVertex> vertices, std::span<const std::uint32_t> indices,
                         std::span<const geometry::VertexLight> light) {
    std::vector<Look> looks;
    looks.reserve(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        looks.push_back(look_of(vertices[i], i < light.size() ? light[i] : geometry::VertexLight{}));
    SmoothFirst sorted;
    sorted.indices.reserve(indices.size());
    std::vector<std::uint32_t> others;
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
        const Look &a = looks[indices[t]], &b = looks[indices[t + 1]], &c = looks[indices[t + 2]];
        const bool smooth = differ_little(a, b) && differ_little(b, c) && differ_little(c, a);
        std::vector<std::uint32_t>& to = smooth ? sorted.indices : others;
        to.insert(to.end(), {indices[t], indices[t + 1], indices[t + 2]});
    }
    sorted.smooth = sorted.indices.size();
    sorted.indices.insert(sorted.indices.end(), others.begin(), others.end());
    return sorted;
}

std::vector<std::vector<std::uint32_t>> by_colour(std::span<const SurfaceVertex> vertices,
                                                  std::span<const std::uint32_t> indices) {
    std::vector<std::vector<std::uint32_t>> parts(1);
    std::vector<std::uint32_t> colours;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t colour = vertices[indices[i]].colour;
        const bool one = vertices[indices[i + 1]].colour == colour && vertices[indices[i + 2]].colour == colour;
        std::size_t part = 0;
        if (one) {
            const auto known = std::ranges::find(colours, colour);
            part = 1 + static_cast<std::size_t>(known - colours.begin());
            if (known == colours.end()) {
                colours.push_back(colour);
                parts.emplace_back();
            }
        }
        parts[part].insert(parts[part].end(), indices.begin() + static_cast<std::ptrdiff_t>(i),
                           indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    return parts;
}

std::vector<std::uint32_t> simplified(std::span<const std::uint32_t> indices, std::span<const SurfaceVertex> vertices,
                                      double error_m) {
    std::vector<std::uint32_t> fewer(indices.size());
    const double scale_m =
        vertices.empty() ? 0.0 : meshopt_simplifyScale(&vertices[0].x, vertices.size(), sizeof(SurfaceVertex));
    if (!(scale_m > 0.0)) return {indices.begin(), indices.end()};
    fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(), &vertices[0].x, vertices.size(),
                                  sizeof(SurfaceVertex), 0, static_cast<float>(error_m / scale_m),
                                  meshopt_SimplifyLockBorder));
    return fewer;
}

std::vector<PatchLevel> coarser_levels(std::span<const SurfaceVertex> vertices, std::span<const std::uint32_t> indices,
                                       std::span<const geometry::VertexLight> light, double edge_m) {
    std::vector<PatchLevel> levels;
    if (indices.empty() || !(edge_m > 0.0)) return levels;
    if (!(meshopt_simplifyScale(&vertices[0].x, vertices.size(), sizeof(SurfaceVertex)) > 0.0)) return levels;
    const std::vector<std::vector<std::uint32_t>> parts = by_colour(vertices, indices);
    const Judge judge(vertices, indices, light);
    const bool all_smooth = smooth_first(vertices, indices, light).smooth == indices.size();
    std::size_t before = indices.size();
    for (const double error : kErrors) {
        PatchLevel level;
        level.indices = parts.front();
        for (std::size_t i = 1; i < parts.size(); ++i) {
            const std::vector<std::uint32_t> fewer = simplified(parts[i], vertices, error * edge_m);
            level.indices.insert(level.indices.end(), fewer.begin(), fewer.end());
        }
        if (static_cast<double>(level.indices.size()) > kWorthIt * static_cast<double>(before)) continue;
        level.error_m = judge.deviation(level.indices);
        if (level.error_m == HUGE_VAL) break;  // a still coarser level would look even more different
        before = level.indices.size();
        SmoothFirst sorted = smooth_first(vertices, level.indices, light);
        level.indices = std::move(sorted.indices);
        level.smooth = all_smooth ? level.indices.size() : sorted.smooth;
        levels.push_back(std::move(level));
    }
    return levels;
}

}  // namespace burin::renderer
