// SPDX-License-Identifier: MIT
// Meshes to touch, and the dull way to find triangles in them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "geometry/contact/local_surface_search.hpp"
#include "geometry/contact/touch_mesh.hpp"

namespace burin::geometry::test {

inline Vec3 random_vector(std::mt19937& random, double half) {
    std::uniform_real_distribution<double> side(-half, half);
    return {side(random), side(random), side(random)};
}

// Triangles of all sizes from a micrometre to a metre, here and there in clusters, none joined to another.
inline TriangleMesh scattered(std::mt19937& random, int count, const Vec3& center_m = Vec3(0.0)) {
    TriangleMesh mesh;
    std::uniform_real_distribution<double> exponent(-6.0, 0.0);
    Vec3 cluster(0.0);
    for (int i = 0; i < count; ++i) {
        if (i % 50 == 0) cluster = random_vector(random, 1.0);
        const double size = std::pow(10.0, exponent(random));
        const Vec3 at = center_m + cluster + random_vector(random, 0.05);
        const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
        for (int k = 0; k < 3; ++k) mesh.positions_m.push_back(at + random_vector(random, size));
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

// A ball of 12 n^2 triangles, by a cube whose faces are pushed out; sides share vertices. Not of the same size all
// over.
inline TriangleMesh ball(int n, double radius_m, const Vec3& center_m = Vec3(0.0)) {
    TriangleMesh mesh;
    std::map<std::tuple<int, int, int>, std::uint32_t> vertex_of;
    const auto vertex = [&](const std::array<int, 3>& p) {
        const auto [at, is_new] = vertex_of.try_emplace({p[0], p[1], p[2]}, std::uint32_t(mesh.positions_m.size()));
        if (is_new) mesh.positions_m.push_back(center_m + radius_m * glm::normalize(Vec3(p[0], p[1], p[2])));
        return at->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {-n, n})
            for (int j = -n; j < n; j += 2)
                for (int i = -n; i < n; i += 2) {
                    const auto at = [&](int u, int v) {
                        std::array<int, 3> p{};
                        p[axis] = side, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = side > 0 ? v : -v;
                        return vertex(p);
                    };
                    const std::uint32_t a = at(i, j), b = at(i + 2, j), c = at(i + 2, j + 2), d = at(i, j + 2);
                    mesh.triangles.push_back({a, b, c});
                    mesh.triangles.push_back({a, c, d});
                }
    return mesh;
}

inline TriangleMesh cube(double half_m) {
    TriangleMesh mesh = ball(1, 1.0);
    for (Vec3& p : mesh.positions_m) p = half_m * glm::sign(p);
    return mesh;
}

// A triangle as what it is, whichever corner comes first: to be put into a set.
using Corners = std::array<std::array<double, 3>, 3>;

inline Corners corners_of(const Triangle& t) {
    Corners c;
    const std::array<Vec3, 3> v{t.a, t.b, t.c};
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::tie(v[k].x, v[k].y, v[k].z) < std::tie(v[least].x, v[least].y, v[least].z)) least = k;
    for (std::size_t k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) c[k][static_cast<std::size_t>(axis)] = v[(least + k) % 3][axis];
    return c;
}

}  // namespace burin::geometry::test
