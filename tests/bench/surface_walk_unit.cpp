// SPDX-License-Identifier: MIT
// The path over any mesh, and the generated meshes: what must hold whatever the seed.
#include "bench/haptics/surface_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bench/measure/bumpy_sphere.hpp"
#include "bench/measure/rough_surfaces.hpp"
#include "geometry/mesh/mesh_health.hpp"

namespace burin::bench {
namespace {

geometry::TriangleMesh square() {  // with two borders on every triangle
    return {{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}, {}, {}};
}

double distance_from_plane(const geometry::TriangleMesh& mesh, const SurfaceWalk& walk) {
    return std::abs(glm::dot(walk.point_m() - mesh.positions_m[mesh.triangles[walk.triangle()][0]], walk.normal()));
}

}  // namespace

TEST(SurfaceWalk, StaysOnItsTriangleAndGoesAtItsSpeed) {
    const geometry::TriangleMesh mesh = mesh_of({}, 30);
    auto walk = SurfaceWalk::create(mesh, 3);
    ASSERT_TRUE(walk.has_value());
    for (int i = 0; i < 5000; ++i) {
        const Vec3 before = walk->point_m();
        walk->advance(1e-4);
        const double went_m = glm::length(walk->point_m() - before);
        EXPECT_LE(went_m, 1e-4 * (1.0 + 1e-9));
        EXPECT_GE(went_m, 0.9e-4);  // a chord over an edge is a little shorter
        EXPECT_LT(distance_from_plane(mesh, *walk), 1e-12);
        EXPECT_NEAR(glm::dot(walk->along(), walk->normal()), 0.0, 1e-12);
    }
    EXPECT_GT(walk->crossings(), 100u);
    EXPECT_EQ(walk->reflections(), 0u);
}

TEST(SurfaceWalk, IsReflectedAtBorders) {
    auto walk = SurfaceWalk::create(square(), 1);
    ASSERT_TRUE(walk.has_value());
    for (int i = 0; i < 20'000; ++i) {
        walk->advance(1e-4);
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GT(walk->point_m()[axis], -1e-9);
            EXPECT_LT(walk->point_m()[axis], 0.1 + 1e-9);
        }
    }
    EXPECT_GT(walk->reflections(), 10u);
}

TEST(SurfaceWalk, GoesOverDetailMuchFinerThanItsStep) {
    const geometry::TriangleMesh comb = needle_comb(20);
    auto walk = SurfaceWalk::create(comb, 1);
    ASSERT_TRUE(walk.has_value());
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 5000; ++i) {
        if (i % 100 == 0) walk->begin_elsewhere();
        walk->advance(0.005);
        seen.insert(walk->triangle());
        EXPECT_LT(distance_from_plane(comb, *walk), 1e-11);
    }
    EXPECT_GT(seen.size(), comb.triangles.size() / 3);
}

TEST(SurfaceWalk, RefusesAMeshWithoutArea) {
    EXPECT_FALSE(SurfaceWalk::create({}, 1).has_value());
    EXPECT_FALSE(SurfaceWalk::create({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, {}, {}, {}}, 1).has_value());
    EXPECT_FALSE(SurfaceWalk::create({{{0, 0, 0}}, {{0, 1, 2}}, {}, {}, {}}, 1).has_value());
}

TEST(PressedWalk, IsAsSmoothAsAHandAndAsDeepAsItSays) {
    const BumpySphere ball{.bumps = 0.0};
    const HandPress press{.depth_m = 0.001, .depth_swing_m = 0.0};
    auto path = PressedWalk::create(mesh_of(ball, 60), press);
    ASSERT_TRUE(path.has_value());
    path->step();
    Vec3 before = path->hip_m(), velocity_before(0.0);
    int pressed = 0;
    for (int i = 0; i < 5000; ++i) {
        path->step();
        const Vec3 velocity = (path->hip_m() - before) / press.tick_s;
        if (path->pressed()) {
            ++pressed;
            EXPECT_NEAR(ball.value_m(path->hip_m()), -0.001, 2e-4);
            EXPECT_LT(glm::length(velocity), 0.105);
            EXPECT_LT(glm::length(velocity - velocity_before), 0.1 * 0.2);  // 20 m/s2 at most: a hand's
            EXPECT_NEAR(glm::length(path->orientation() * Vec3(0, 1, 0) - path->outward()), 0.0, 1e-12);
        }
        before = path->hip_m(), velocity_before = velocity;
    }
    EXPECT_GT(pressed, 3500);
}

TEST(RoughSurfaces, AreClosedTurnedOutwardsAndOfTheirSize) {
    for (const auto& mesh : {rough_ball(20'000), rough_plate(20'000), file_plate(), machined_part(), needle_comb()}) {
        const geometry::MeshHealth health = geometry::examine(mesh);
        EXPECT_TRUE(geometry::complaints(health).empty());
        EXPECT_GT(health.signed_volume_m3, 0.0);
        EXPECT_EQ(health.shells, 1u);
        const Vec3 extent = health.bounds_m.extent();
        EXPECT_NEAR(std::max({extent.x, extent.y, extent.z}), 0.1, 0.015);
    }
    EXPECT_EQ(rough_ball(2'000).positions_m, rough_ball(2'000).positions_m);
}

}  // namespace burin::bench
