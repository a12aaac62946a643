// SPDX-License-Identifier: MIT
// Kinematics of the twin pantograph: against themselves over a million poses, against differences, and against values
// of the maker's own formulas.
#include "devices/haptic/twin_pantograph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "devices/haptic/wand_description.hpp"

namespace burin::devices {
namespace {

constexpr double kPi = 3.141592653589793;

// Poses of the wand's own workspace that the linkages reach.
class ReachedPoses {
public:
    explicit ReachedPoses(unsigned seed) : random_(seed) {}
    WandAxis next() {
        while (true) {
            ++tried_;
            const Vec3 middle(0.24 * within(), 0.21 + 0.125 * within(), 0.225 * within());
            const double pitch = 65.0 * kDegree_rad * within(), roll = 85.0 * kDegree_rad * within();
            const Quat turn = glm::angleAxis(pitch, Vec3(1, 0, 0)) * glm::angleAxis(roll, Vec3(0, 1, 0));
            const WandAxis axis{middle, turn * Vec3(0, 0, 1)};
            if (wand_joints(arm, axis)) return axis;
        }
    }
    double within() { return std::uniform_real_distribution(-1.0, 1.0)(random_); }
    [[nodiscard]] long tried() const { return tried_; }
    TwinPantograph arm;

private:
    std::mt19937_64 random_;
    long tried_ = 0;
};

// How the handle moves: of its middle, and about axes across its own.
struct Twist {
    Vec3 moves{0.0}, turns{0.0};
};
WandAxis moved(const WandAxis& axis, const Twist& twist, double by) {
    const double angle = by * glm::length(twist.turns);
    const Quat turn = angle == 0.0 ? Quat(1, 0, 0, 0) : glm::angleAxis(angle, glm::normalize(twist.turns));
    return {axis.middle_m + by * twist.moves, turn * axis.along};
}

}  // namespace

TEST(TwinPantograph, ForwardOfInverseGivesThePoseBackOverAMillionPoses) {
    ReachedPoses poses(1);
    double worst_m = 0.0, worst_turn = 0.0, worst_length_m = 0.0;
    for (int i = 0; i < 1'000'000; ++i) {
        const WandAxis wanted = poses.next();
        const auto tips = wand_tips(poses.arm, *wand_joints(poses.arm, wanted));
        ASSERT_TRUE(tips);
        const WandAxis found = wand_axis(*tips);
        worst_m = std::max(worst_m, glm::distance(found.middle_m, wanted.middle_m));
        worst_turn = std::max(worst_turn, glm::distance(found.along, wanted.along));
        worst_length_m = std::max(worst_length_m, std::abs(handle_error_m(poses.arm, *tips)));
    }
    RecordProperty("worst_m", std::to_string(worst_m));
    std::printf("worst of a million: %.3g m, %.3g rad, %.3g m of the handle; %ld poses tried\n", worst_m, worst_turn,
                worst_length_m, poses.tried());
    EXPECT_LT(worst_m, 1e-9);
    EXPECT_LT(worst_turn, 1e-9);
    EXPECT_LT(worst_length_m, 1e-9);
}

// Values of the maker's own formulas (quanser_sdk_examples, forward_kinematics), evaluated outside of this
// program: joints, then x, y, z, roll about x, pitch about y.
TEST(TwinPantograph, AgreesWithTheMakersFormulas) {
    struct Case {
        WandJoints joints;
        Vec3 middle_m;
        double about_x, about_y;
    };
    const std::array cases{Case{{0.12760527954869, 3.0139873740411, 0.12760527954869, 3.0139873740411, 0, 0},
                                Vec3(1.66533453693773e-16, 0.124024552966507, 0),
                                -0,
                                0},
                           Case{{0.5, 2.4, 0.3, 2.6, 0.2, -0.1},
                                Vec3(0.0218710240198376, 0.194853116159274, 0.01280475604625),
                                -0.130054047789855,
                                0.0162182712274053},
                           Case{{0.9, 2.9, 0.7, 2.8, -0.3, -0.2},
                                Vec3(-0.0473376576558045, 0.195282667378662, -0.049974467393095),
                                -0.0393894881159006,
                                -0.155522023250918},
                           Case{{0.2, 2.2, 0.4, 2.1, 0.4, 0.5},
                                Vec3(0.0693237539531495, 0.195146386323173, 0.0951339304547468),
                                0.188033917353924,
                                0.00659202378044648}};
    const TwinPantograph arm;
    for (const Case& one : cases) {
        const auto tips = wand_tips(arm, one.joints);
        ASSERT_TRUE(tips);
        const WandAxis axis = wand_axis(*tips);
        EXPECT_NEAR(axis.middle_m.x, one.middle_m.x, 1e-12);
        EXPECT_NEAR(axis.middle_m.y, one.middle_m.y, 1e-12);
        EXPECT_NEAR(axis.middle_m.z, one.middle_m.z, 1e-12);
        EXPECT_NEAR(-std::atan2(axis.along.y, axis.along.z), one.about_x, 1e-12);
        EXPECT_NEAR(std::atan2(axis.along.x, axis.along.z), one.about_y, 1e-12);
    }
}

TEST(TwinPantograph, StandsLevelInTheJigAsTheMakersOffsetsSay) {
    const TwinPantograph arm;
    constexpr double kRight = 0.12760527954869, kLeft = 3.0139873740411;
    const auto tips = wand_tips(arm, {kRight, kLeft, kRight, kLeft, 0.0, 0.0});
    ASSERT_TRUE(tips);
    const WandAxis axis = wand_axis(*tips);
    EXPECT_NEAR(axis.middle_m.x, 0.0, 1e-12);
    EXPECT_NEAR(axis.middle_m.y, 0.123, 0.002) << "the thesis' [0, 0, 123] mm, whose last number is outwards";
    EXPECT_NEAR(axis.middle_m.z, 0.0, 1e-12);
    EXPECT_NEAR(handle_error_m(arm, *tips), 0.0, 1e-12);
    EXPECT_NEAR(handle_length_m(arm), 8.32232120 * 0.0254, 1e-12) << "the maker's link 3";
}

// The power at the motors is that at the handle, whatever it does. The joints' speeds are differences of the inverse
// kinematics, which know nothing of the Jacobian: of the sixth order, so that they are exact to 1e-11.
TEST(TwinPantograph, ForcesDoTheSameWorkAtHandleAndMotors) {
    ReachedPoses poses(2);
    double worst = 0.0;
    int compared = 0;
    while (compared < 20'000) {
        const WandAxis axis = poses.next();
        Twist twist{Vec3(poses.within(), poses.within(), poses.within()),
                    5.0 * Vec3(poses.within(), poses.within(), poses.within())};
        twist.turns -= glm::dot(twist.turns, axis.along) * axis.along;
        constexpr double kStep = 5e-5;
        constexpr std::array<double, 3> kWeight{45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0};
        WandJoints speeds{};
        bool is_reached = true;
        for (int k = 1; k <= 6 && is_reached; ++k)  // a margin around the stencil: no singular pose beside it
            is_reached = wand_joints(poses.arm, moved(axis, twist, 40.0 * k * kStep)) &&
                         wand_joints(poses.arm, moved(axis, twist, -40.0 * k * kStep));
        if (!is_reached) continue;
        for (int k = 1; k <= 3; ++k) {
            const auto ahead = wand_joints(poses.arm, moved(axis, twist, k * kStep));
            const auto behind = wand_joints(poses.arm, moved(axis, twist, -k * kStep));
            for (std::size_t j = 0; j < kWandJoints; ++j)
                speeds[j] += kWeight[static_cast<std::size_t>(k - 1)] * ((*ahead)[j] - (*behind)[j]) / kStep;
        }
        const auto joints = wand_joints(poses.arm, axis);
        const auto jacobian = wand_jacobian(poses.arm, *joints);
        ASSERT_TRUE(jacobian);
        const WandForce force{3.0 * Vec3(poses.within(), poses.within(), poses.within()),
                              0.25 * Vec3(poses.within(), poses.within(), poses.within())};
        const WandJoints torques = motor_torques_Nm(poses.arm, axis, *jacobian, force);
        double at_motors_W = 0.0, flow_W = 0.0;
        for (std::size_t j = 0; j < kWandJoints; ++j) {
            at_motors_W += torques[j] * speeds[j];
            flow_W += std::abs(torques[j] * speeds[j]);
        }
        const double at_handle_W = glm::dot(force.force_N, twist.moves) + glm::dot(force.torque_Nm, twist.turns);
        worst = std::max(worst, std::abs(at_motors_W - at_handle_W) / std::max(1.0, flow_W));
        ++compared;
    }
    std::printf("worst difference of power: %.3g of what flows\n", worst);
    EXPECT_LT(worst, 1e-9);
}

TEST(TwinPantograph, MotorsGiveTheForceBackAndNothingAboutTheHandlesOwnAxis) {
    ReachedPoses poses(3);
    for (int i = 0; i < 20'000; ++i) {
        const WandAxis axis = poses.next();
        const auto jacobian = wand_jacobian(poses.arm, *wand_joints(poses.arm, axis));
        ASSERT_TRUE(jacobian);
        const WandForce wanted{Vec3(poses.within(), poses.within(), poses.within()),
                               0.2 * Vec3(poses.within(), poses.within(), poses.within())};
        const auto given = force_of(poses.arm, axis, *jacobian, motor_torques_Nm(poses.arm, axis, *jacobian, wanted));
        if (!given) continue;
        const Vec3 across = wanted.torque_Nm - glm::dot(wanted.torque_Nm, axis.along) * axis.along;
        EXPECT_LT(glm::distance(given->force_N, wanted.force_N), 1e-9);
        EXPECT_LT(glm::distance(given->torque_Nm, across), 1e-9);
    }
}

TEST(TwinPantograph, GivesNothingWhereTheLinkagesDoNotReach) {
    const TwinPantograph arm;
    EXPECT_FALSE(wand_joints(arm, {Vec3(0.0, 0.5, 0.0), Vec3(0, 0, 1)}));
    EXPECT_FALSE(wand_joints(arm, {Vec3(0.0, 0.0, 0.0), Vec3(0, 0, 1)}));
    TwinPantograph short_arm;
    short_arm.fore_m = 0.5 * (arm.shoulders_m + 2.0 * arm.upper_m);
    EXPECT_FALSE(wand_tips(short_arm, {0.0, kPi, 0.0, kPi, 0.0, 0.0})) << "fore links in one line";
    EXPECT_FALSE(wand_jacobian(short_arm, {0.0, kPi, 0.0, kPi, 0.0, 0.0}));
    EXPECT_FALSE(wand_tips(arm, {std::nan(""), 3.0, 0.1, 3.0, 0.0, 0.0}));
    EXPECT_FALSE(wand_joints(arm, {Vec3(std::nan("")), Vec3(0, 0, 1)}));
}

TEST(TwinPantograph, AHandlesTurnIsTheShortestOntoItsAxis) {
    ReachedPoses poses(4);
    for (int i = 0; i < 1000; ++i) {
        const WandAxis axis = poses.next();
        const Pose pose = pose_of(axis);
        EXPECT_LT(glm::distance(axis_of(pose).along, axis.along), 1e-12);
        EXPECT_NEAR(pose.orientation.z, 0.0, 1e-12) << "it turns about no part of its own axis";
    }
}

}  // namespace burin::devices
