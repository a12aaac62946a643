// SPDX-License-Identifier: MIT
#include "bodies/mesh/embedded_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace burin::bodies {
namespace {

struct Icosphere {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

Icosphere icosahedron() {
    const double t = 0.5 * (1.0 + std::sqrt(5.0));
    Icosphere ball;
    for (const Vec3& p :
         {Vec3(-1, t, 0), Vec3(1, t, 0), Vec3(-1, -t, 0), Vec3(1, -t, 0), Vec3(0, -1, t), Vec3(0, 1, t),
          Vec3(0, -1, -t), Vec3(0, 1, -t), Vec3(t, 0, -1), Vec3(t, 0, 1), Vec3(-t, 0, -1), Vec3(-t, 0, 1)})
        ball.points.push_back(glm::normalize(p));
    ball.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return ball;
}

Icosphere divided(const Icosphere& ball) {
    Icosphere finer{ball.points, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(finer.points.size()));
        if (is_new) finer.points.push_back(glm::normalize(finer.points[a] + finer.points[b]));
        return at->second;
    };
    for (const auto& [a, b, c] : ball.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.triangles.insert(finer.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return finer;
}

// Returns the place as a mean of a cell's corners.
Anchor anchor_in(const Tetrahedra& body, const Tetrahedra::Cell& cell, const Vec3& place_m) {
    const auto p = [&](std::size_t i) { return body.places_m[cell[i]]; };
    const double whole = volume_m3(p(0), p(1), p(2), p(3));
    return {cell,
            {volume_m3(place_m, p(1), p(2), p(3)) / whole, volume_m3(p(0), place_m, p(2), p(3)) / whole,
             volume_m3(p(0), p(1), place_m, p(3)) / whole, volume_m3(p(0), p(1), p(2), place_m) / whole}};
}

// Returns the anchor in the cell that holds the place, or that it is least outside of.
Anchor anchor_of(const Tetrahedra& body, const Vec3& place_m) {
    Anchor best;
    double least = -std::numeric_limits<double>::infinity();
    for (const Tetrahedra::Cell& cell : body.cells) {
        const Anchor anchor = anchor_in(body, cell, place_m);
        const double share = *std::ranges::min_element(anchor.shares);
        if (share <= least) continue;
        least = share;
        best = anchor;
    }
    return best;
}

}  // namespace

EmbeddedSurface ellipsoid_surface(const Tetrahedra& body, const Vec3& half_axes_m, unsigned level) {
    Icosphere ball = icosahedron();
    for (unsigned i = 0; i < level; ++i) ball = divided(ball);
    EmbeddedSurface surface;
    surface.triangles = std::move(ball.triangles);
    for (Vec3& point : ball.points) {
        point *= half_axes_m;
        surface.points.push_back(anchor_of(body, point));
    }
    surface.areas_m2.assign(surface.points.size(), 0.0);
    for (const auto& triangle : surface.triangles) {
        const auto& [a, b, c] = triangle;
        const double area =
            0.5 * glm::length(glm::cross(ball.points[b] - ball.points[a], ball.points[c] - ball.points[a]));
        for (const std::uint32_t corner : triangle) surface.areas_m2[corner] += area / 3.0;
    }
    return surface;
}

std::vector<Vec3> places_of(const EmbeddedSurface& surface, std::span<const Vec3> places_m) {
    std::vector<Vec3> places;
    places.reserve(surface.points.size());
    for (const Anchor& point : surface.points) places.push_back(place_of(point, places_m));
    return places;
}

}  // namespace burin::bodies
