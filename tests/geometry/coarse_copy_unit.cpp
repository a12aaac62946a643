// SPDX-License-Identifier: MIT
#include "geometry/mesh/coarse_copy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace burin::geometry {
namespace {

// A ball of radius 1 with about 2 * across^2 triangles.
TriangleMesh fine_ball(std::uint32_t across) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i <= across; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const double t = std::numbers::pi * i / across, p = 2.0 * std::numbers::pi * j / across;
            mesh.positions_m.emplace_back(std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p));
        }
    }
    for (std::uint32_t i = 0; i < across; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const std::uint32_t next = (j + 1) % across, a = i * across + j, b = (i + 1) * across + j;
            mesh.triangles.push_back({a, i * across + next, b});
            mesh.triangles.push_back({i * across + next, (i + 1) * across + next, b});
        }
    }
    return mesh;
}

}  // namespace

TEST(CoarseCopy, OfASmallMeshIsTheMesh) {
    const TriangleMesh ball = fine_ball(20);
    const TriangleMesh copy = coarse_copy(ball, 800, 4);
    EXPECT_EQ(copy.triangles, ball.triangles);
    EXPECT_EQ(copy.positions_m.size(), ball.positions_m.size());
}

TEST(CoarseCopy, OfALargeMeshIsFarSmallerAndWithinACell) {
    TriangleMesh ball = fine_ball(400);
    ball.materials = {{"a", {1, 2, 3}}, {"b", {4, 5, 6}}};
    ball.triangle_materials.assign(ball.triangles.size(), 1);
    ball.positions_m.emplace_back(1e6);  // in no triangle: it makes no cell larger
    constexpr int kCells = 32;
    const TriangleMesh copy = coarse_copy(ball, 1000, kCells);
    EXPECT_LT(copy.triangles.size(), ball.triangles.size() / 10);
    EXPECT_GT(copy.triangles.size(), 2000u);
    const double cell = 2.0 / kCells;
    for (const Vec3& p : copy.positions_m) {
        EXPECT_GT(glm::length(p), 1.0 - std::sqrt(3.0) * cell);
        EXPECT_LT(glm::length(p), 1.0 + 1e-12) << "the mean of points of a ball lies within it";
    }
    ASSERT_EQ(copy.triangle_materials.size(), copy.triangles.size());
    EXPECT_EQ(copy.materials.size(), 2u);
    EXPECT_EQ(copy.triangle_materials.front(), 1);
    for (const auto& t : copy.triangles) EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
}

TEST(CoarseCopy, OfNothingAndOfAPointIsNothing) {
    EXPECT_TRUE(coarse_copy({}, 0, 8).triangles.empty());
    const TriangleMesh point{{Vec3(1.0), Vec3(1.0), Vec3(1.0)}, {{0, 1, 2}}, {}, {}, {}};
    EXPECT_TRUE(coarse_copy(point, 0, 8).triangles.empty());
}

}  // namespace burin::geometry
