// SPDX-License-Identifier: MIT
// Where points of the room appear on the screens of a wall, in millimetres, against closed forms that know no matrix.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/wall/wall_samples.hpp"
#include "wall/projection.hpp"

namespace burin::wall {
namespace {

constexpr double kScreenTolerance_m = 1e-5;  // 0.01 mm on the wall

// Where the matrix puts a point: metres from the screen's lower left corner, rightwards and upwards.
Vec2 projected_on(const Screen& screen, const Vec3& eye, const Vec3& p) {
    const glm::dvec4 clip = off_axis_projection(screen, eye, 0.01, 100.0) * glm::dvec4(p, 1.0);
    const double width_m = glm::length(screen.lower_right_world - screen.lower_left_world);
    const double height_m = glm::length(screen.upper_left_world - screen.lower_left_world);
    return {(clip.x / clip.w + 1.0) * 0.5 * width_m, (1.0 - clip.y / clip.w) * 0.5 * height_m};
}

// By similar triangles in the room's own coordinates, for each plane of the cave by hand: the line e + k (p - e) meets
// x = -1.5, z = 0, x = 1.5 or y = 0.
Vec2 expected_in_cave(const std::string& screen, const Vec3& e, const Vec3& p) {
    const auto meet = [&](double k) { return e + k * (p - e); };
    if (screen == "left") {
        const Vec3 hit = meet((-1.5 - e.x) / (p.x - e.x));
        return {3.0 - hit.z, hit.y};
    }
    if (screen == "right") {
        const Vec3 hit = meet((1.5 - e.x) / (p.x - e.x));
        return {hit.z, hit.y};
    }
    if (screen == "floor") {
        const Vec3 hit = meet((0.0 - e.y) / (p.y - e.y));
        return {hit.x + 1.5, 3.0 - hit.z};
    }
    const Vec3 hit = meet((0.0 - e.z) / (p.z - e.z));
    return {hit.x + 1.5, hit.y};
}

// How far in front of the cave's screen, in the room's coordinates.
double before(const std::string& screen, const Vec3& p) {
    return screen == "left" ? p.x + 1.5 : screen == "right" ? 1.5 - p.x : screen == "floor" ? p.y : p.z;
}

}  // namespace

TEST(StereoGeometry, DisparitiesOnEveryScreenOfACaveEqualTheClosedFormForTenTurnedHeads) {
    const WallSetup setup = cave();
    std::mt19937 random(3);
    int compared = 0;
    for (const Pose& head : kHeads) {
        const auto views = views_of(setup, {head, head});
        ASSERT_EQ(views.size(), 4u);
        for (std::size_t i = 0; i < views.size(); ++i) {
            ASSERT_TRUE(views[i].visible);
            const std::string& name = setup.screens[i].name;
            for (int trial = 0; trial < 50; ++trial) {
                const Vec3 p = Vec3{0, 1.5, 1.0} + random_vector(random, 3.0);
                const Eyes& eyes = views[i].eyes;
                // Only what is well before the eyes has a place on the screen.
                if (before(name, p) > 0.9 * std::min(before(name, eyes.left_world), before(name, eyes.right_world)))
                    continue;
                const Vec2 left = projected_on(views[i].screen, eyes.left_world, p);
                const Vec2 right = projected_on(views[i].screen, eyes.right_world, p);
                const Vec2 left_true = expected_in_cave(name, eyes.left_world, p);
                const Vec2 right_true = expected_in_cave(name, eyes.right_world, p);
                EXPECT_LT(glm::length(left - left_true), kScreenTolerance_m) << name;
                EXPECT_LT(glm::length(right - right_true), kScreenTolerance_m) << name;
                EXPECT_LT(glm::length((right - left) - (right_true - left_true)), kScreenTolerance_m) << name;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 500);
}

// An eye 2 cm before the wall and 3 m beside its middle: 89.6 degrees from its normal.
TEST(StereoGeometry, HoldsForAnEyeThatLooksAlongTheWall) {
    const Screen wall = screen_of(Wall{});
    for (const Vec3& e : {Vec3{3.0, 1.1, 0.02}, {-9.0, 5.0, 0.05}, {0.0, 40.0, 0.3}, {1.5, 0.0, 0.0101}}) {
        for (const Vec3& p : {Vec3{0.4, 1.3, -0.5}, {-1.2, 0.2, -3.0}, {1.0, 2.0, 0.004}}) {
            const double k = e.z / (e.z - p.z);
            const Vec2 expected{e.x + (p.x - e.x) * k + 1.524, e.y + (p.y - e.y) * k};
            EXPECT_LT(glm::length(projected_on(wall, e, p) - expected), kScreenTolerance_m);
        }
    }
}

// One point seen on two screens of a cave is one point of the room: the lines from eye to both places are one line.
TEST(StereoGeometry, ScreensThatMeetShowOneRoom) {
    const WallSetup setup = cave();
    for (const Pose& head : kHeads) {
        const auto views = views_of(setup, {head, head});
        for (const double height : {0.1, 1.2, 2.9}) {
            const Vec3 corner{-1.5, height, 0.0};  // where left and front meet
            const Vec3 beyond = views[0].eyes.left_world + 2.5 * (corner - views[0].eyes.left_world);
            const Vec2 on_left = projected_on(views[0].screen, views[0].eyes.left_world, beyond);
            const Vec2 on_front = projected_on(views[1].screen, views[1].eyes.left_world, beyond);
            EXPECT_NEAR(on_left.x, 3.0, kScreenTolerance_m);
            EXPECT_NEAR(on_front.x, 0.0, kScreenTolerance_m);
            EXPECT_NEAR(on_left.y, height, kScreenTolerance_m);
            EXPECT_NEAR(on_front.y, height, kScreenTolerance_m);
        }
    }
}

TEST(StereoGeometry, TheTrackersFrameAndTheSensorsPlaceOnTheHeadChangeNothingButTheNumbers) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 100; ++trial) {
        const WallSetup plain = cave();
        // The tracker hangs somewhere, turned; the sensor sits somewhere on the head, turned.
        const Pose tracker_from_world{random_vector(random, 3.0), random_rotation(random)};
        const Pose head_from_sensor{random_vector(random, 0.2), random_rotation(random)};
        const auto inverted = [](const Pose& p) {
            const Quat back = glm::conjugate(p.orientation);
            return Pose{-(back * p.position_m), back};
        };
        const auto product = [](const Pose& a, const Pose& b) {
            return Pose{a * b.position_m, a.orientation * b.orientation};
        };
        WallSetup odd = plain;
        odd.world_from_tracker = inverted(tracker_from_world);
        for (WallScreen& s : odd.screens) {
            s.lower_left_tracker = tracker_from_world * s.lower_left_tracker;
            s.lower_right_tracker = tracker_from_world * s.lower_right_tracker;
            s.upper_left_tracker = tracker_from_world * s.upper_left_tracker;
        }
        odd.eyes = {inverted(head_from_sensor) * plain.eyes.left_sensor,
                    inverted(head_from_sensor) * plain.eyes.right_sensor};
        const Pose& head = kHeads[static_cast<std::size_t>(trial) % kHeads.size()];
        const Pose sensor = product(product(tracker_from_world, head), head_from_sensor);
        const auto a = views_of(plain, {head, head}), b = views_of(odd, {sensor, sensor});
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_LT(glm::length(a[i].eyes.left_world - b[i].eyes.left_world), 1e-9);
            EXPECT_LT(glm::length(a[i].eyes.right_world - b[i].eyes.right_world), 1e-9);
            EXPECT_LT(glm::length(a[i].screen.upper_left_world - b[i].screen.upper_left_world), 1e-9);
        }
    }
}

// The head's own axis, however it is turned: a head on its side has its eyes above each other.
TEST(StereoGeometry, EyesLieAlongTheHeadsAxis) {
    const WallSetup setup = powerwall();
    const Pose on_its_side{{0, 1.6, 2}, turned(0, 0, std::numbers::pi / 2)};
    const Eyes eyes = eyes_world(setup, {on_its_side, on_its_side});
    EXPECT_NEAR(eyes.right_world.y - eyes.left_world.y, 0.063, 1e-12);
    EXPECT_NEAR(eyes.right_world.x - eyes.left_world.x, 0.0, 1e-12);
    const Pose backwards{{0, 1.6, 2}, turned(std::numbers::pi, 0, 0)};
    EXPECT_LT(eyes_world(setup, {backwards, backwards}).right_world.x, 0.0);
}

// Left and right picture are shown at their own times: each eye comes from its own pose.
TEST(StereoGeometry, EachEyeComesFromThePoseOfItsOwnTime) {
    const WallSetup setup = powerwall();
    const Eyes eyes = eyes_world(setup, {kHeads[0], kHeads[6]});
    EXPECT_EQ(eyes.left_world, kHeads[0] * setup.eyes.left_sensor);
    EXPECT_EQ(eyes.right_world, kHeads[6] * setup.eyes.right_sensor);
}

TEST(StereoGeometry, AViewerMadeOfTwoEyesHasThoseEyes) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 1000; ++trial) {
        const Vec3 left = random_vector(random, 2.0), right = left + random_vector(random, 0.05);
        const Quat near = random_rotation(random);
        const Eyes eyes = eyes_of(viewer_with({left, right}, near));
        EXPECT_LT(glm::length(eyes.left_world - left), 1e-12);
        EXPECT_LT(glm::length(eyes.right_world - right), 1e-12);
    }
    const Viewer kept = viewer_with(eyes_of({kHeads[6], 0.063}), kHeads[6].orientation);
    EXPECT_NEAR(std::abs(glm::dot(kept.head_world.orientation, kHeads[6].orientation)), 1.0, 1e-12);
    const Eyes opposite{{0.03, 0, 0}, {-0.03, 0, 0}};
    EXPECT_LT(glm::length(eyes_of(viewer_with(opposite)).right_world - opposite.right_world), 1e-12);
    EXPECT_EQ(viewer_with({{1, 2, 3}, {1, 2, 3}}).interpupillary_m, 0.0);
}

TEST(StereoGeometry, AScreenBehindAnEyeIsLeftDark) {
    const Pose outside{{-1.52, 1.6, 1.5}, turned(0, 0, 0)};  // through the cave's left wall
    const auto views = views_of(cave(), {outside, outside});
    EXPECT_FALSE(views[0].visible);
    EXPECT_TRUE(views[1].visible);
}

}  // namespace burin::wall
