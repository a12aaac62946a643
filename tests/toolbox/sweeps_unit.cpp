// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "toolbox/tool_options.hpp"

namespace burin::toolbox {
namespace {

const Tool kSweptBall{compute::BallTool{0.01}, compute::Operation::cut, 3};
const Tool kCylinder{compute::CylinderTool{0.01, 0.02}, compute::Operation::fill, 2};

}  // namespace

TEST(Sweeps, AStraightRunBecomesOneSweep) {
    std::vector<Pose> poses;
    for (int i = 0; i <= 10; ++i) poses.push_back({Vec3(i * 0.001, 0.0, 0.0)});
    for (const Tool& tool : {kSweptBall, kCylinder}) {
        const auto sweeps = sweeps_along(poses, tool, 1e-6);
        ASSERT_EQ(sweeps.size(), 1u);
        EXPECT_EQ(sweeps[0].start.position_m, poses.front().position_m);
        EXPECT_EQ(sweeps[0].end.position_m, poses.back().position_m);
        EXPECT_EQ(sweeps[0].material, tool.material);
        EXPECT_EQ(sweeps[0].operation, tool.operation);
    }
    EXPECT_EQ(sweeps_along(poses, kSweptBall, -1.0).size(), 10u);  // nothing merged
}

TEST(Sweeps, AnArcStaysWithinToleranceAndKeepsItsEnds) {
    constexpr double kTolerance = 1e-3;
    std::vector<Pose> poses;
    for (int i = 0; i <= 90; ++i) poses.push_back({Vec3(std::cos(i * M_PI / 180), std::sin(i * M_PI / 180), 0.0)});
    const auto sweeps = sweeps_along(poses, kSweptBall, kTolerance);
    EXPECT_EQ(sweeps.size(), 18u);  // a chord of angle a lies a^2 / 8 from the arc: five of the one-degree steps each
    EXPECT_EQ(sweeps.front().start.position_m, poses.front().position_m);
    EXPECT_EQ(sweeps.back().end.position_m, poses.back().position_m);
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        if (i > 0) {
            EXPECT_EQ(sweeps[i].start.position_m, sweeps[i - 1].end.position_m);
        }
        const Vec3 middle = 0.5 * (sweeps[i].start.position_m + sweeps[i].end.position_m);
        EXPECT_GT(glm::length(middle), 1.0 - 1.01 * kTolerance);
    }
}

TEST(Sweeps, ATurningToolIsNotMergedButABallIs) {
    std::vector<Pose> poses;
    for (int i = 0; i <= 10; ++i) {
        const double half = i < 5 ? 0.0 : 0.05 * (i - 4);
        poses.push_back({Vec3(i * 0.001, 0.0, 0.0), Quat(std::cos(half), std::sin(half), 0, 0)});
    }
    EXPECT_EQ(sweeps_along(poses, kSweptBall, 1e-6).size(), 1u);
    const auto sweeps = sweeps_along(poses, kCylinder, 1e-6);
    ASSERT_EQ(sweeps.size(), 7u);  // poses 0 to 4, then each step
    EXPECT_EQ(sweeps[0].end.position_m, poses[4].position_m);
    EXPECT_EQ(sweeps[1].end.orientation, poses[5].orientation);
}

TEST(Sweeps, APointIsAStampAndNothingIsNothing) {
    const std::vector<Pose> pose{{Vec3(1, 2, 3)}};
    ASSERT_EQ(sweeps_along(pose, kSweptBall, 1.0).size(), 1u);
    EXPECT_TRUE(sweeps_along({}, kSweptBall, 1.0).empty());
}

}  // namespace burin::toolbox
