// SPDX-License-Identifier: MIT
// Meshes that a scene draws: sharp where they are sharp, smooth where they are smooth.
#include "picture/drawn_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "picture/frame_setup.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::picture {
namespace {

Vec3 decoded(std::uint32_t code) {
    const auto n = shared::decode_normal(code);
    return glm::normalize(Vec3(n.x, n.y, n.z));
}

geometry::TriangleMesh cuboid(const Vec3& half) {
    geometry::TriangleMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions_m.emplace_back((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                      (i & 4) != 0 ? half.z : -half.z);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

// A tube along +Y without lids.
geometry::TriangleMesh tube(double radius_m, std::uint32_t around) {
    geometry::TriangleMesh mesh;
    for (std::uint32_t k = 0; k < around; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / around;
        for (const double y : {0.0, 1.0})
            mesh.positions_m.emplace_back(radius_m * std::cos(angle), y, radius_m * std::sin(angle));
        const std::uint32_t a = 2 * k, b = 2 * ((k + 1) % around);
        mesh.triangles.push_back({a, a + 1, b});
        mesh.triangles.push_back({b, a + 1, b + 1});
    }
    return mesh;
}

// A cone whose point is so many triangles' corner; a disc where it has no height.
geometry::TriangleMesh cone(double height_m, std::uint32_t around) {
    geometry::TriangleMesh mesh;
    mesh.positions_m.emplace_back(0.0, 0.0, height_m);
    for (std::uint32_t k = 0; k < around; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / around;
        mesh.positions_m.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % around});
    }
    return mesh;
}

}  // namespace

TEST(DrawnMesh, KeepsTheEdgesOfABoxSharp) {
    const auto drawn = drawn_mesh(cuboid({1.0, 2.0, 3.0}));
    EXPECT_EQ(drawn->indices.size(), 36u);
    EXPECT_EQ(drawn->vertices.size(), 24u) << "each corner once for each of its three faces";
    EXPECT_EQ(drawn->bounds, (Box{{-1, -2, -3}, {1, 2, 3}}));
    for (std::size_t i = 0; i < drawn->indices.size(); i += 3) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& v = drawn->vertices[drawn->indices[i + k]];
            p[k] = {v.x, v.y, v.z};
        }
        const Vec3 face = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        EXPECT_GT(glm::dot(face, p[0]), 0.0) << "outward";
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_GT(glm::dot(decoded(drawn->vertices[drawn->indices[i + k]].normal), face), 1.0 - 1e-6);
    }
}

TEST(DrawnMesh, IsRoundWhereFacesTurnLittle) {
    const auto drawn = drawn_mesh(tube(0.5, 48));
    EXPECT_EQ(drawn->vertices.size(), 96u) << "one normal at each corner";
    for (const shared::SurfaceVertex& v : drawn->vertices) {
        const Vec3 out = glm::normalize(Vec3(v.x, 0.0, v.z));
        EXPECT_GT(glm::dot(decoded(v.normal), out), std::cos(std::numbers::pi / 48.0) - 1e-6);
    }
}

TEST(DrawnMesh, LeavesOutWhatHasNoAreaAndColoursByMaterial) {
    geometry::TriangleMesh mesh = cuboid(Vec3(1.0));
    mesh.triangles.push_back({0, 0, 1});
    mesh.materials = {{"red", {255, 0, 0}}, {"blue", {0, 0, 255}}};
    mesh.triangle_materials.assign(mesh.triangles.size(), 0);
    mesh.triangle_materials[0] = 1;
    const auto drawn = drawn_mesh(mesh);
    EXPECT_EQ(drawn->indices.size(), 36u);
    std::set<std::uint32_t> colours;
    for (const auto& v : drawn->vertices) colours.insert(v.colour);
    EXPECT_EQ(colours, (std::set<std::uint32_t>{0xff0000ffu, 0xffff0000u}));
    EXPECT_TRUE(drawn_mesh({})->indices.empty());
}

// What a tool's shadow and darkening are bounded by follows its spine.
TEST(BallsOf, CoverTheSpineOfAToolThatIsNoBall) {
    PictureTool tool;
    tool.visible = true;
    tool.radius_m = 0.01;
    tool.center_world = {0.1, 0.2, 0.3};
    for (const double length_m : {0.0, 0.005, 0.02, 0.05, 0.3}) {
        tool.spine_m = length_m * glm::normalize(Vec3(1, 2, -1));
        const auto balls = balls_of(tool);
        for (int i = 0; i <= 100; ++i) {
            const Vec3 on_spine = tool.center_world + (i / 100.0) * tool.spine_m;
            const bool held = std::ranges::any_of(balls, [&](const Ball& ball) {
                return glm::length(on_spine - ball.center_world) + tool.radius_m <= ball.radius_m + 1e-12;
            });
            ASSERT_TRUE(held) << length_m << " " << i;
        }
    }
}

TEST(HeadOf, BoundsATurnedMesh) {
    PictureTool tool;
    tool.visible = true;
    tool.mesh = drawn_mesh(cuboid({0.01, 0.02, 0.03}));
    tool.world_from_mesh = {{1.0, 2.0, 3.0}, glm::angleAxis(0.7, glm::normalize(Vec3(1, 2, 3))), 2.0};
    const Box head = head_of(tool);
    for (const auto& v : tool.mesh->vertices) {
        const Vec3 p = tool.world_from_mesh * Vec3(v.x, v.y, v.z);
        for (int i = 0; i < 3; ++i) {
            EXPECT_GE(p[i], head.lo[i] - 1e-6);
            EXPECT_LE(p[i], head.hi[i] + 1e-6);
        }
        EXPECT_LE(glm::length(p - ball_of(tool).center_world), ball_of(tool).radius_m + 1e-6);
    }
}

// Each of the fan's triangles was compared with each other: a world with such a mesh did not open for minutes.
TEST(DrawnMesh, OfAFanCostsNoSquareOfItsTriangles) {
    constexpr std::uint32_t kFan = 1'000'000;
    const auto drawn = drawn_mesh(cone(0.0, kFan));
    EXPECT_EQ(drawn->vertices.size(), kFan + 1u) << "one normal at the middle";
    for (const shared::SurfaceVertex& v : {drawn->vertices.front(), drawn->vertices.back()})
        EXPECT_GT(decoded(v.normal).z, 1.0 - 1e-6);
}

// The same cone with few and with very many triangles at its point: of the same normals there, to a few degrees.
TEST(DrawnMesh, IsAsSmoothWhereVeryManyTrianglesMeet) {
    const auto fine = drawn_mesh(cone(1.0, 4096)), coarse = drawn_mesh(cone(1.0, 128));
    const auto at_the_point = [](const DrawnMesh& mesh, std::size_t triangle) {
        return decoded(mesh.vertices[mesh.indices[3 * triangle]].normal);
    };
    for (std::size_t k = 0; k < 128; ++k)
        EXPECT_GT(glm::dot(at_the_point(*fine, 32 * k + 16), at_the_point(*coarse, k)), std::cos(0.1)) << k;
}

}  // namespace burin::picture
