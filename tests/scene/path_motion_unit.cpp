// SPDX-License-Identifier: MIT
// Between its keys a path goes as evenly as its keys lie: no key slows it down, and none hurries it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/scene_motion.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::scene {
namespace {

// A step so short, and the error of a velocity over it: its acceleration may change within the step.
constexpr double kPathStep_s = 1e-6, kPathError = 1e-5;

Velocities velocity_on(const PathMotion& path, double time_s) {
    return velocities_between(pose_on(path, time_s - kPathStep_s), pose_on(path, time_s + kPathStep_s),
                              2.0 * kPathStep_s);
}

using Times = std::vector<double>;
const std::array<Times, 3> kKeyTimes{Times{0.0, 0.5, 1.0, 1.5, 2.0, 2.5}, Times{0.0, 0.2, 1.1, 1.4, 2.3, 2.5},
                                     Times{0.0, 0.9, 1.0, 1.7, 1.85, 3.0}};

}  // namespace

// Of a path that stays at its ends the first and last part begin and end at rest; all between is even.
TEST(PathMotion, OnALineAtASteadyPaceGoesEvenlyThroughEveryKeyHoweverTheirTimesLie) {
    for (const Times& times : kKeyTimes)
        for (std::size_t i = 0; i < kUnevenPoses; ++i) {
            const Vec3 velocity = kUnevenScales[i] * uneven_offset(i);
            PathMotion path{{}, false};
            for (const double t : times)
                path.keys.push_back({t, {uneven_offset(i + 1) + t * velocity, uneven_turn(i)}});
            ASSERT_TRUE(problems(path).empty());
            for (double t = times[1]; t <= times[times.size() - 2]; t += 0.01) {
                const Velocities found = velocity_on(path, t);
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(found.linear_m_per_s[k], velocity[k], kPathError) << t << " " << k;
                EXPECT_LT(glm::length(found.angular_rad_per_s), kPathError) << t;
            }
        }
}

TEST(PathMotion, OfThreeKeysOnALineIsAtTheMiddleOneAsFastAsFromEndToEnd) {
    for (const double middle_s : {1.0, 0.6, 1.5}) {
        const Vec3 way(0.3, -0.17, 0.46);
        const PathMotion path{{{0.0, {uneven_offset(0), uneven_turn(0)}},
                               {middle_s, {uneven_offset(0) + 0.5 * middle_s * way, uneven_turn(0)}},
                               {2.0, {uneven_offset(0) + way, uneven_turn(0)}}},
                              false};
        const Velocities found = velocity_on(path, middle_s);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(found.linear_m_per_s[k], 0.5 * way[k], kPathError) << middle_s << " " << k;
    }
}

// Componentwise interpolation of turns by up to a quarter of a radian bends the pace by some thousandths.
TEST(PathMotion, ThatTurnsAtASteadyPaceTurnsEvenlyThroughEveryKey) {
    for (const Times& times : kKeyTimes)
        for (const double rate_rad_per_s : {0.25, -0.25}) {
            PathMotion path{{}, false};
            path.about_m = uneven_offset(2);
            for (std::size_t k = 0; k < times.size(); ++k) {
                const Quat turn = glm::angleAxis(rate_rad_per_s * times[k], uneven_direction(1)) * uneven_turn(3);
                path.keys.push_back({times[k], {uneven_offset(1), k % 2 == 0 ? turn : -turn}});
            }
            ASSERT_TRUE(problems(path).empty());
            const Vec3 expected = rate_rad_per_s * uneven_direction(1);
            for (double t = times[1]; t <= times[times.size() - 2]; t += 0.01)
                EXPECT_LT(glm::length(velocity_on(path, t).angular_rad_per_s - expected), 0.01 * 0.25) << t;
        }
}

// Round a circle and over the seam where it begins again.
TEST(PathMotion, ThatRepeatsGoesOnAtTheSamePaceWhereItBeginsAgain) {
    constexpr int kKeys = 24;
    constexpr double kRadius_m = 0.3, kRound_s = 6.0;
    PathMotion path;
    for (int k = 0; k <= kKeys; ++k) {
        // Uneven times, at the angles that belong to them.
        const double share = (k + (k % 3 == 1 ? 0.3 : 0.0)) / kKeys, angle = 2.0 * std::numbers::pi * share;
        path.keys.push_back({kRound_s * share,
                             {uneven_turn(2) * (kRadius_m * Vec3(std::cos(angle), std::sin(angle), 0.0)),
                              uneven_turn(2) * glm::angleAxis(angle, Vec3(0.0, 0.0, 1.0))}});
    }
    ASSERT_TRUE(problems(path).empty());
    const double speed = 2.0 * std::numbers::pi * kRadius_m / kRound_s, turning = 2.0 * std::numbers::pi / kRound_s;
    for (double t = 0.001; t < 2.2 * kRound_s; t += 0.01) {
        const Velocities found = velocity_on(path, t);
        const double angle = turning * t;
        const Vec3 expected = uneven_turn(2) * (speed * Vec3(-std::sin(angle), std::cos(angle), 0.0));
        EXPECT_LT(glm::length(found.linear_m_per_s - expected), 0.08 * speed) << t;
        EXPECT_NEAR(glm::length(found.angular_rad_per_s), turning, 0.04 * turning) << t;
    }
}

}  // namespace burin::scene
