// SPDX-License-Identifier: MIT
#include "wall/projection.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "tests/wall/wall_samples.hpp"

namespace burin::wall {

namespace {

constexpr double kTolerance_m = 1e-5;  // 0.01 mm on the wall

// Where a matrix puts a point, in metres from the wall's lower left corner.
Vec2 projected(const Mat4& clip_from_world, const Wall& wall, const Vec3& p) {
    const glm::dvec4 clip = clip_from_world * glm::dvec4(p, 1.0);
    return {(clip.x / clip.w + 1.0) * 0.5 * wall.width_m, (1.0 - clip.y / clip.w) * 0.5 * wall.height_m};
}

const std::array<Pose, 10> kHeadsAtOneWall{{{{0.0, 1.143, 2.0}, turned(0, 0, 0)},
                                            {{0.5, 1.6, 1.5}, turned(0, 0, 0)},
                                            {{-0.9, 1.7, 2.5}, turned(0.3, 0, 0)},
                                            {{1.4, 1.2, 0.6}, turned(-0.6, 0.1, 0)},
                                            {{0.0, 1.8, 3.2}, turned(0, -0.2, 0.1)},
                                            {{2.2, 1.5, 1.0}, turned(0.9, 0, 0)},
                                            {{-2.0, 0.9, 1.8}, turned(-0.4, 0.3, -0.2)},
                                            {{0.2, 2.0, 0.4}, turned(0, 0, 0.5)},
                                            {{0.1, 1.5, 5.0}, turned(0.2, 0.2, 0.2)},
                                            {{-0.3, 1.65, 2.1}, turned(0, 0, 1.5707963267948966)}}};

const std::array<Vec3, 6> kPoints{
    {{0, 1.1, 0}, {0.3, 1.4, 0.25}, {-0.8, 0.4, -1.0}, {0, 1.2, 0.2}, {1.2, 2.0, -3.0}, {0.05, 1.143, 0.3}}};

}  // namespace

// By similar triangles: an eye at e and a point at p meet the plane z = 0 at x = e.x + (p.x - e.x) e.z / (e.z - p.z).
TEST(OffAxisProjection, PutsKnownPointsAndDisparitiesOnTheWallForTenHeads) {
    const Wall wall;
    for (const Pose& head : kHeadsAtOneWall) {
        const Eyes eyes = eyes_of({head, 0.063});
        for (const Vec3& p : kPoints) {
            std::array<Vec2, 2> seen, expected;
            for (std::size_t i = 0; i < 2; ++i) {
                const Vec3 e = i == 0 ? eyes.left_world : eyes.right_world;
                const double k = e.z / (e.z - p.z);
                expected[i] = {e.x + (p.x - e.x) * k + 0.5 * wall.width_m, e.y + (p.y - e.y) * k};
                seen[i] = projected(off_axis_projection(screen_of(wall), e, 0.05, 100.0), wall, p);
                EXPECT_NEAR(seen[i].x, expected[i].x, kTolerance_m);
                EXPECT_NEAR(seen[i].y, expected[i].y, kTolerance_m);
                const Vec2 traced = point_on_screen(screen_of(wall), e, p);
                EXPECT_NEAR(traced.x, expected[i].x, kTolerance_m);
                EXPECT_NEAR(traced.y, expected[i].y, kTolerance_m);
            }
            EXPECT_NEAR(seen[1].x - seen[0].x, expected[1].x - expected[0].x, kTolerance_m);
        }
    }
}

// For a head that looks straight at the wall, disparity = -ipd z / (d - z): crossed (negative) in front, positive
// behind.
TEST(OffAxisProjection, GivesCrossedDisparityInFrontAndUncrossedBehind) {
    const Wall wall;
    constexpr double ipd = 0.063, d = 2.0;
    const Eyes eyes = eyes_of({{{0.1, 1.6, d}, Quat{1, 0, 0, 0}}, ipd});
    for (const double z : {-5.0, -1.0, -0.1, 0.0, 0.1, 0.5, 1.0}) {
        const Vec3 p{0.2, 1.3, z};
        const auto x = [&](const Vec3& e) {
            return projected(off_axis_projection(screen_of(wall), e, 0.05, 100.0), wall, p).x;
        };
        const double disparity = x(eyes.right_world) - x(eyes.left_world);
        EXPECT_NEAR(disparity, -ipd * z / (d - z), kTolerance_m) << "at z = " << z;
        EXPECT_LT(disparity, ipd) << "the eyes would have to diverge";
    }
}

TEST(OffAxisProjection, MapsTheScreensCornersToThePicturesCorners) {
    const Wall wall;
    const Screen s = screen_of(wall);
    for (const Pose& head : kHeadsAtOneWall) {
        const Mat4 m = off_axis_projection(s, head.position_m, 0.05, 100.0);
        const Vec3 upper_right = s.lower_right_world + s.upper_left_world - s.lower_left_world;
        const std::array<std::pair<Vec3, Vec2>, 4> corners{{{s.lower_left_world, {-1, 1}},
                                                            {s.lower_right_world, {1, 1}},
                                                            {s.upper_left_world, {-1, -1}},
                                                            {upper_right, {1, -1}}}};
        for (const auto& [world, ndc] : corners) {
            const glm::dvec4 clip = m * glm::dvec4(world, 1.0);
            EXPECT_NEAR(clip.x / clip.w, ndc.x, 1e-12);
            EXPECT_NEAR(clip.y / clip.w, ndc.y, 1e-12);  // y downwards
        }
    }
}

TEST(OffAxisProjection, PutsTheNearPlaneAtDepth0AndTheFarPlaneAt1) {
    const Vec3 eye{0.4, 1.5, 1.7};
    const Mat4 m = off_axis_projection(screen_of(Wall{}), eye, 0.2, 30.0);
    const auto depth = [&](double distance_m) {
        const glm::dvec4 clip = m * glm::dvec4(0.3, 1.0, eye.z - distance_m, 1.0);
        return clip.z / clip.w;
    };
    EXPECT_NEAR(depth(0.2), 0.0, 1e-12);
    EXPECT_NEAR(depth(30.0), 1.0, 1e-12);
    EXPECT_LT(depth(1.0), depth(1.001));
}

// Moving screen, eye and point together changes nothing: a tilted screen is as good as the wall.
TEST(OffAxisProjection, DoesNotDependOnWhereTheScreenStands) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    const Wall wall;
    for (int trial = 0; trial < 200; ++trial) {
        const Pose move{{value(random), value(random), value(random)},
                        turned(3 * value(random), 3 * value(random), 3 * value(random))};
        const Screen s = screen_of(wall);
        const Screen moved{move * s.lower_left_world, move * s.lower_right_world, move * s.upper_left_world};
        const Vec3 eye{value(random), 1.2 + value(random), 2.0 + value(random)};
        const Vec3 p{value(random), 1.0 + value(random), 0.5 * value(random)};
        const Vec2 a = projected(off_axis_projection(s, eye, 0.05, 50.0), wall, p);
        const Vec2 b = projected(off_axis_projection(moved, move * eye, 0.05, 50.0), wall, move * p);
        EXPECT_NEAR(a.x, b.x, 1e-9);
        EXPECT_NEAR(a.y, b.y, 1e-9);
    }
}

TEST(Eyes, LieOnTheHeadsOwnAxisHoweverItIsTurned) {
    for (const Pose& head : kHeadsAtOneWall) {
        const Eyes eyes = eyes_of({head, 0.070});
        const Vec3 apart = eyes.right_world - eyes.left_world;
        EXPECT_NEAR(glm::length(apart), 0.070, 1e-12);
        EXPECT_NEAR(glm::length(0.5 * (eyes.left_world + eyes.right_world) - head.position_m), 0.0, 1e-12);
        EXPECT_NEAR(glm::dot(apart, head.orientation * Vec3{1, 0, 0}), 0.070, 1e-12);
    }
}

TEST(CanBeSeen, RefusesEyesBehindTheScreenAndScreensWithoutArea) {
    const Screen wall = screen_of(Wall{});
    const Eyes in_front = eyes_of(Viewer{});
    EXPECT_TRUE(can_be_seen(wall, in_front));
    EXPECT_FALSE(can_be_seen(wall, {{0, 1, -1}, {0.06, 1, -1}}));
    EXPECT_FALSE(can_be_seen(wall, {{0, 1, 1}, {0.06, 1, 0.0}}));
    EXPECT_FALSE(can_be_seen({{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}, in_front));
    EXPECT_FALSE(can_be_seen({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}}, in_front)) << "a slanted screen has no frustum";
    const double nan = std::nan("");
    EXPECT_FALSE(can_be_seen({{0, nan, 0}, {1, 0, 0}, {0, 1, 0}}, in_front));
    EXPECT_FALSE(can_be_seen(wall, {{0, 1, nan}, {0, 1, 1}}));
}

}  // namespace burin::wall
