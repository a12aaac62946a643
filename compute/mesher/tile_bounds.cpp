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
using Double2 = double __attribute__((vector_size(16)));  // of a quad's two triangles

// The longest edge, squared, and the sum of the triangles' normals, each as long as twice its triangle's area.
struct EdgesAndNormals {
    float longest2 = 0.0f;
    Vec3 normal_sum{0.0};
};

EdgesAndNormals over_triangles(const SurfaceTile& tile) {
    EdgesAndNormals all;
    for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
        const auto place = [&](std::size_t k) { return geometry::place_of(tile.vertices[tile.indices[i + k]]); };
        const Vec3f a = place(0), b = place(1), c = place(2);
        const Vec3f ab = b - a, bc = c - b, ca = a - c;
        all.longest2 = std::max({all.longest2, glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
        all.normal_sum += glm::cross(Vec3(b) - Vec3(a), Vec3(c) - Vec3(a));
    }
    return all;
}

Float4 greater(const Float4& a, const Float4& b) { return a > b ? a : b; }

// One coordinate of a quad's corners in doubles, relative to the corner where its two triangles begin: of the second
// corner of each triangle, and of the third.
struct Sides {
    explicit Sides(const Float4& x) {
        const Double2 low = __builtin_convertvector(__builtin_shufflevector(x, x, 0, 1), Double2),
                      high = __builtin_convertvector(__builtin_shufflevector(x, x, 2, 3), Double2);
        const Double2 first = __builtin_shufflevector(low, low, 0, 0);
        second = __builtin_shufflevector(low, high, 1, 2) - first;
        third = high - first;
    }
    Double2 second, third;
};

// The same for a tile of quads alone: both triangles of a quad at once, with the same bits.
EdgesAndNormals over_quads(const SurfaceTile& tile) {
    Float4 longest2{};
    EdgesAndNormals all;
    for (std::size_t i = 0; i < tile.indices.size(); i += 6) {
        const std::uint32_t* const index = &tile.indices[i];
        // Triangles 0, 1, 2 and 0, 2, 3 of the polygon; or 0, 2, 1 and 0, 3, 2.
        const bool flip = index[1] == index[5];
        const auto [x, y, z] =
            QuadCorners(tile.vertices.data(), index[0], index[flip ? 2 : 1], index[flip ? 1 : 2], index[flip ? 4 : 5]);
        const Float4 side_x = x - BURIN_SHUFFLED(x, 1, 2, 3, 0), side_y = y - BURIN_SHUFFLED(y, 1, 2, 3, 0),
                     side_z = z - BURIN_SHUFFLED(z, 1, 2, 3, 0);
        // From corners 0 and 2 to each other, and from 1 and 3 to one of these.
        const Float4 across_x = x - BURIN_SHUFFLED(x, 2, 2, 0, 0), across_y = y - BURIN_SHUFFLED(y, 2, 2, 0, 0),
                     across_z = z - BURIN_SHUFFLED(z, 2, 2, 0, 0);
        const Float4 side2 = side_x * side_x + side_y * side_y + side_z * side_z,
                     across2 = across_x * across_x + across_y * across_y + across_z * across_z;
        longest2 = greater(side2, greater(across2, longest2));

        const Sides sx(x), sy(y), sz(z);
        const double sign = flip ? -1.0 : 1.0;
        const Double2 nx = (sy.second * sz.third - sy.third * sz.second) * sign,
                      ny = (sz.second * sx.third - sz.third * sx.second) * sign,
                      nz = (sx.second * sy.third - sx.third * sy.second) * sign;
        all.normal_sum += Vec3(nx[0], ny[0], nz[0]);
        all.normal_sum += Vec3(nx[1], ny[1], nz[1]);
    }
    for (int k = 0; k < 4; ++k) all.longest2 = std::max(all.longest2, longest2[k]);
    return all;
}

// Returns the height of the highest corner along the normal. Vertices that no triangle uses do not count.
double top_of(const SurfaceTile& tile, const Vec3& normal, std::vector<double>& heights) {
    heights.resize(tile.vertices.size());
    for (std::size_t v = 0; v < heights.size(); ++v) {
        heights[v] = glm::dot(normal, Vec3(geometry::place_of(tile.vertices[v])));
    }
    std::array<double, 3> top{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (std::size_t i = 0; i < tile.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) top[k] = std::max(top[k], heights[tile.indices[i + k]]);
    }
    return std::max({top[0], top[1], top[2]});
}

}  // namespace

TileBounds bounds_of(const SurfaceTile& tile, std::vector<double>& heights) {
    const EdgesAndNormals all = tile.only_quads() ? over_quads(tile) : over_triangles(tile);
    TileBounds bounds{std::sqrt(all.longest2), {}};
    const double length = std::sqrt(glm::dot(all.normal_sum, all.normal_sum));
    if (!(length > 0.0) || !(length < HUGE_VAL)) return bounds;
    bounds.slab.normal = Vec3f(all.normal_sum / length);
    bounds.slab.top_m = top_of(tile, Vec3(bounds.slab.normal), heights);
    return bounds;
}

}  // namespace burin::compute
