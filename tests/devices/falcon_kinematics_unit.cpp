// SPDX-License-Identifier: MIT
// The legs of a Falcon: their inverse, their forward solution and their forces, against each other, against chains
// that are built link by link, and against what libnifalcon computes.
#include "devices/falcon/falcon_kinematics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace burin::devices {
namespace {

constexpr double kHalfBox_m = 0.0508;

// Poses in the box of four inches, of whose corners the legs do not reach all.
class RandomGrips {
public:
    explicit RandomGrips(std::uint64_t seed) : random_(seed) {}
    Vec3 next() { return kFalconMiddle_m + kHalfBox_m * Vec3(way_(random_), way_(random_), way_(random_)); }
    Vec3 force_N() { return 8.0 * Vec3(way_(random_), way_(random_), way_(random_)); }

private:
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> way_{-1.0, 1.0};
};

}  // namespace

TEST(FalconKinematics, ForwardOfInverseIsWithinANanometreOverAMillionPoses) {
    RandomGrips grips(1);
    double worst_m = 0.0;
    int reached = 0, solved = 0;
    constexpr int kPoses = 1'000'000;
    for (int i = 0; i < kPoses; ++i) {
        const Vec3 grip_m = grips.next();
        const auto angles = falcon_inverse(grip_m);
        if (!angles) continue;
        ++reached;
        const auto pose = falcon_forward(*angles);
        if (!pose) continue;
        ++solved;
        worst_m = std::max(worst_m, glm::distance(pose->grip_m, grip_m));
    }
    EXPECT_GT(reached, kPoses * 9 / 10);
    EXPECT_EQ(solved, reached);
    EXPECT_LT(worst_m, 1e-9);
    RecordProperty("worst_pm", static_cast<int>(worst_m * 1e12));
}

// The chain of a leg, from its foot on the base to the grip, with joint angles of our choice.
TEST(FalconKinematics, InverseFindsTheAngleOfAChainThatWasBuiltForwards) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> arm(-0.6, 1.4), knee(0.9, 2.2), across(-0.35, 0.35);
    constexpr double kDegree = std::numbers::pi / 180.0;
    constexpr std::array<double, 3> kLegs{105.0 * kDegree, -15.0 * kDegree, -135.0 * kDegree};
    int reached = 0;
    for (int i = 0; i < 30'000; ++i) {
        const auto leg = static_cast<std::size_t>(i % 3);
        const double angle = arm(random), bend = angle + knee(random), tilt = across(random);
        const Vec3 foot(0.040, -0.02309, 0.0), arm_m(0.060 * std::cos(angle), 0.0, 0.060 * std::sin(angle));
        const double shin_m = 2.0 * 0.01125 + 0.1025 * std::cos(tilt);
        const Vec3 shin(shin_m * std::cos(bend), 0.1025 * std::sin(tilt), shin_m * std::sin(bend));
        const Vec3 to_middle(-0.01443, 0.025, 0.0);
        const Vec3 in_leg = foot + arm_m + shin + to_middle;
        const double c = std::cos(kLegs[leg]), s = std::sin(kLegs[leg]);
        const Vec3 grip_m(c * in_leg.x - s * in_leg.y, s * in_leg.x + c * in_leg.y, in_leg.z);
        const auto angles = falcon_inverse(grip_m);
        if (!angles) continue;  // another leg does not reach there
        ++reached;
        ASSERT_NEAR((*angles)[leg], angle, 1e-9);
    }
    EXPECT_GT(reached, 10'000);
}

TEST(FalconKinematics, TorquesDoTheWorkThatTheForceDoes) {
    RandomGrips grips(3);
    double worst = 0.0;
    int counted = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 grip_m = grips.next(), force_N = grips.force_N();
        const auto angles = falcon_inverse(grip_m);
        const auto pose = angles ? falcon_forward(*angles) : std::nullopt;
        if (!pose || glm::length(grip_m - kFalconMiddle_m) > 0.045) continue;
        ++counted;
        const FalconAngles torques = falcon_torques(*pose, force_N);
        for (std::size_t leg = 0; leg < kFalconLegs; ++leg) {
            // Work a radian, by a difference of fourth order of the forward solution, which knows no derivative.
            constexpr double kStep = 2e-4;
            const auto place = [&](double steps) {
                FalconAngles turned = *angles;
                turned[leg] += steps * kStep;
                return falcon_forward(turned, grip_m).value().grip_m;
            };
            const Vec3 moves = (8.0 * (place(1) - place(-1)) - (place(2) - place(-2))) / (12.0 * kStep);
            worst = std::max(worst, std::abs(torques[leg] - glm::dot(moves, force_N)));
        }
        // And back: the force that these torques give.
        ASSERT_LT(glm::distance(falcon_force(*pose, torques), force_N), 1e-9);
    }
    EXPECT_GT(counted, 5000);
    EXPECT_LT(worst, 1e-9) << "newton metres";
}

// Computed by libnifalcon f7c727a, with its two faults mended (docs/decisions/034-falcon.md).
TEST(FalconKinematics, AgreesWithLibnifalcon) {
    struct Known {
        Vec3 grip_m;
        FalconAngles angles;
        Vec3 force_N;
        FalconCounts commands;
    };
    const std::array known{
        Known{{0.0, 0.0, 0.1245}, {0.477015, 0.477015, 0.477015}, {0.0, 0.0, 2.0}, {-505, -505, -505}},
        Known{{0.02, -0.03, 0.11}, {0.757538, 0.053398, 0.300611}, {1.0, -0.5, 0.25}, {-520, 375, -262}},
        Known{{-0.035, 0.01, 0.14}, {0.590690, 1.087251, 0.622906}, {-2.0, 1.0, 1.0}, {656, -1786, 125}},
        Known{{0.01, 0.04, 0.09}, {-0.417327, 0.164833, 0.628868}, {0.5, 2.0, -3.0}, {1453, 485, -1067}},
    };
    for (const Known& one : known) {
        const auto angles = falcon_inverse(one.grip_m);
        ASSERT_TRUE(angles);
        const auto pose = falcon_forward(*angles);
        ASSERT_TRUE(pose);
        const FalconCounts commands = falcon_commands(falcon_torques(*pose, one.force_N));
        for (std::size_t leg = 0; leg < kFalconLegs; ++leg) {
            EXPECT_NEAR((*angles)[leg], one.angles[leg], 1e-6);
            EXPECT_LE(std::abs(commands[leg] - one.commands[leg]), 1);
        }
    }
}

TEST(FalconKinematics, SaysWhereThereIsNoPose) {
    EXPECT_FALSE(falcon_inverse(Vec3(0.0, 0.0, 0.5)));
    EXPECT_FALSE(falcon_inverse(Vec3(0.3, 0.0, 0.12)));
    EXPECT_FALSE(falcon_inverse(Vec3(std::nan(""), 0.0, 0.12)));
    const double nan = std::nan("");
    EXPECT_FALSE(falcon_forward({nan, 0.5, 0.5}));
    EXPECT_FALSE(falcon_forward({0.5, 0.5, 0.5}, Vec3(nan)));
    EXPECT_FALSE(falcon_forward(falcon_angles({-4000, 4000, 0})));
    EXPECT_EQ(falcon_commands({nan, 0.1, 0.1}), FalconCounts{});
    // Whatever the encoders read: a pose that they belong to, or none.
    std::mt19937 random(4);
    std::uniform_int_distribution<int> count(-6000, 6000);
    int found = 0;
    for (int i = 0; i < 100'000; ++i) {
        const auto encoders =
            FalconCounts{static_cast<std::int16_t>(count(random)), static_cast<std::int16_t>(count(random)),
                         static_cast<std::int16_t>(count(random))};
        const auto pose = falcon_forward(falcon_angles(encoders));
        if (!pose) continue;
        ++found;
        ASSERT_TRUE(finite(pose->grip_m));
        ASSERT_GT(pose->grip_m.z, 0.0);
        const auto angles = falcon_inverse(pose->grip_m);
        ASSERT_TRUE(angles);
        for (std::size_t leg = 0; leg < kFalconLegs; ++leg)
            ASSERT_NEAR((*angles)[leg], falcon_angles(encoders)[leg], 1e-6);
    }
    EXPECT_GT(found, 0);
}

TEST(FalconKinematics, AStepOfItsEncodersIsAStepOfTheAngle) {
    EXPECT_EQ(falcon_encoders(falcon_angles({123, -456, 789})), (FalconCounts{123, -456, 789}));
    // 0.0364 degrees a count (docs of the hardware; 360 / 1280 * 14.25 / 110).
    const double step = falcon_angles({1, 0, 0})[0] - falcon_angles({})[0];
    EXPECT_NEAR(step * 180.0 / std::numbers::pi, 0.0364, 0.0001);
    EXPECT_EQ(falcon_encoders({1e9, -1e9, 0.0})[0], 32767);
    EXPECT_EQ(falcon_encoders({1e9, -1e9, 0.0})[1], -32768);
}

TEST(FalconKinematics, MotorsThatAreAskedTooMuchKeepTheDirection) {
    const FalconCounts commands = falcon_commands({-2.0, 1.0, 0.5});
    EXPECT_EQ(commands, (FalconCounts{4096, -2048, -1024}));
    EXPECT_EQ(falcon_commands({0.1, 0.0, -0.1}), (FalconCounts{-1000, 0, 1000}));
}

}  // namespace burin::devices
