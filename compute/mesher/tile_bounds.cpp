// SPDX-License-Identifier: MIT
#include "compute/mesher/tile_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "compute/mesher/quad_corners.hpp"
#include "shaders/shared/vectors.h"

namespace burin::compute {
namespace {

using geometry::SurfaceTile;
using shared::Float4;

Float4 greater(const Float4& a, const Float4& b) { return a > b ? a : b; }

float longest2_of_triangles(const SurfaceTile& tile) {
    float longest2 = 0.0f;
    const auto place = [&](std::size_t i) { return geometry::place_of(tile.vertices[tile.indices[i]]); };
    for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
        const Vec3f a = place(i), b = place(i + 1), c = place(i + 2);
        const Vec3f ab = b - a, bc = c - b, ca = a - c;
        longest2 = std::max({longest2, glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
    }
    return longest2;
}

// Returns the longest edge of a tile of quads alone, squared: looks at each side and the diagonal once.
float longest2_of_quads(const SurfaceTile& tile) {
    Float4 longest2{};
    for (std::size_t i = 0; i < tile.indices.size(); i += 6) {
        const std::uint32_t* const index = &tile.indices[i];
        // Triangles 0, 1, 2 and 0, 2, 3 of the polygon; or 0, 2, 1 and 0, 3, 2.
        const bool flip = index[1] == index[5];
        const QuadCorners p(tile.vertices.data(), index[0], index[flip ? 2 : 1], index[flip ? 1 : 2],
                            index[flip ? 4 : 5]);
        const Float4 side_x = p.x - BURIN_SHUFFLED(p.x, 1, 2, 3, 0), side_y = p.y - BURIN_SHUFFLED(p.y, 1, 2, 3, 0),
                     side_z = p.z - BURIN_SHUFFLED(p.z, 1, 2, 3, 0);
        // From corners 0 and 2 to each other, and from 1 and 3 to one of these.
        const Float4 across_x = p.x - BURIN_SHUFFLED(p.x, 2, 2, 0, 0), across_y = p.y - BURIN_SHUFFLED(p.y, 2, 2, 0, 0),
                     across_z = p.z - BURIN_SHUFFLED(p.z, 2, 2, 0, 0);
        const Float4 side2 = side_x * side_x + side_y * side_y + side_z * side_z,
                     across2 = across_x * across_x + across_y * across_y + across_z * across_z;
        longest2 = greater(side2, greater(across2, longest2));
    }
    return std::max({longest2[0], longest2[1], longest2[2], longest2[3]});
}

// As geometry::slab_around, but converts each vertex to doubles, and finds its height, once. Vertices that no triangle
// uses do not count.
geometry::TriangleSlab slab_of(const SurfaceTile& tile, std::vector<Vec3>& places) {
    places.resize(tile.vertices.size());
    for (std::size_t v = 0; v < places.size(); ++v) places[v] = Vec3(geometry::place_of(tile.vertices[v]));
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
        const Vec3& a = places[tile.indices[i]];
        sum += glm::cross(places[tile.indices[i + 1]] - a, places[tile.indices[i + 2]] - a);
    }
    const double length = std::sqrt(glm::dot(sum, sum));
    if (!(length > 0.0) || !(length < HUGE_VAL)) return {};
    const Vec3f normal(sum / length);
    for (Vec3& place : places) place.x = glm::dot(Vec3(normal), place);
    std::array<double, 3> top{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) top[k] = std::max(top[k], places[tile.indices[i + k]].x);
    }
    return {normal, std::max({top[0], top[1], top[2]})};
}

}  // namespace

TileBounds bounds_of(const SurfaceTile& tile, std::vector<Vec3>& places) {
    const float longest2 = tile.only_quads() ? longest2_of_quads(tile) : longest2_of_triangles(tile);
    return {std::sqrt(longest2), slab_of(tile, places)};
}

}  // namespace burin::compute
