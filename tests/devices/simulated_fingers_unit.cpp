// SPDX-License-Identifier: MIT
// A simulated device of several parts, and the joints of a description.
#include "devices/haptic/simulated_fingers.hpp"
#include "tests/support/test_units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace burin::devices {
namespace {

SimulatedHand moving_along(int axis) {
    Vec3 to(0.0);
    to[axis] = 0.01;
    return *SimulatedHand::create({{0.0, Vec3(0.0)}, {0.5, to}});
}

}  // namespace

TEST(SimulatedFingers, EachPartFollowsItsOwnHand) {
    SimulatedFingers fingers({moving_along(0), moving_along(1), moving_along(2)});
    ASSERT_EQ(fingers.count(), 3u);
    for (int i = 0; i < 1500; ++i) fingers.advance(kMs);
    for (int part = 0; part < 3; ++part) {
        const Vec3 at = fingers.part(static_cast<std::size_t>(part)).read().position_device_m;
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(at[axis], axis == part ? 0.01 : 0.0, 0.0006) << part;
    }
}

TEST(SimulatedFingers, AForceMovesItsPartAlone) {
    const HandGrip let_go{0.0, 0.0, 0.0};
    std::vector<SimulatedHand> hands;
    for (int i = 0; i < 2; ++i) hands.push_back(*SimulatedHand::create({{0.0, Vec3(0.0)}}, HandPath::straight, let_go));
    SimulatedFingers fingers(std::move(hands));
    fingers.part(0).write({{0.5, 0.0, 0.0}});
    fingers.advance(50 * kMs);
    EXPECT_GT(fingers.part(0).read().position_device_m.x, 0.005);
    EXPECT_EQ(fingers.part(1).read().position_device_m, Vec3(0.0));
}

TEST(SimulatedFingers, APartsFaultIsItsOwnAndALostLinkIsOfAll) {
    SimulatedFingers fingers({moving_along(0), moving_along(1)});
    fingers.inject(1, InjectedFault::disconnected);
    EXPECT_EQ(fingers.part(0).read().fault, DeviceFault::none);
    EXPECT_EQ(fingers.part(1).read().fault, DeviceFault::disconnected);
    EXPECT_FALSE(fingers.part(1).read().fault_is_of_all);
    fingers.inject(1, InjectedFault::none);
    fingers.part(0).write({{1.0, 0.0, 0.0}});
    fingers.advance(2 * kMs);
    EXPECT_EQ(fingers.part(0).arm().acting_force_device_N(), Vec3(1.0, 0.0, 0.0));
    fingers.lose_link(true);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(fingers.part(i).read().fault, DeviceFault::disconnected);
        EXPECT_TRUE(fingers.part(i).read().fault_is_of_all);
    }
    fingers.part(0).write({{1.0, 0.0, 0.0}});
    fingers.advance(2 * kMs);
    EXPECT_EQ(fingers.part(0).arm().acting_force_device_N(), Vec3(0.0));
    fingers.lose_link(false);
    EXPECT_EQ(fingers.part(0).read().fault, DeviceFault::none);
}

// ---- Joints

namespace {
// An arm of two hinges in a plane, 4096 steps a turn each.
Joints two_hinges() {
    Joints joints;
    joints.count = 2;
    for (std::size_t i = 0; i < 2; ++i)
        joints.all[i] = {.step = 2.0 * std::numbers::pi / 4096.0, .lowest = -1.0, .highest = 2.0, .max_effort = 0.3};
    return joints;
}
}  // namespace

TEST(Joints, TheStepAtTheHandleIsWhatAllEncodersMakeTogetherAlongItsWorstAxis) {
    // Links of 0.13 m at 0.4 and 1.1 rad: no step of both encoders moves the tip farther along x or y than this, and
    // one does.
    const double l = 0.13, a = 0.4, b = 1.1, step = two_hinges().all[0].step;
    const auto tip = [&](double p, double q) {
        return Vec3(l * std::cos(p) + l * std::cos(p + q), l * std::sin(p) + l * std::sin(p + q), 0.0);
    };
    const Vec3 columns[] = {{-l * std::sin(a) - l * std::sin(a + b), l * std::cos(a) + l * std::cos(a + b), 0.0},
                            {-l * std::sin(a + b), l * std::cos(a + b), 0.0}};
    double worst = 0.0;
    for (const double i : {-step, step})
        for (const double j : {-step, step}) {
            const Vec3 moved = tip(a + i, b + j) - tip(a, b);
            worst = std::max({worst, std::abs(moved.x), std::abs(moved.y)});
        }
    EXPECT_NEAR(step_at_handle(two_hinges(), columns), worst, 1e-3 * worst);
    EXPECT_EQ(step_at_handle(Joints{}, columns), 0.0) << "nothing is known";
    EXPECT_EQ(step_at_handle(two_hinges(), {}), 0.0);
}

TEST(Joints, AnglesThatNoHandHasBroughtAboutAreTold) {
    const Joints joints = two_hinges();
    EXPECT_TRUE(within_limits(joints, {0.0, 2.0}));
    EXPECT_TRUE(within_limits(joints, {-1.0 - 0.5 * joints.all[0].step, 0.0})) << "rounding to a step";
    EXPECT_FALSE(within_limits(joints, {-1.1, 0.0}));
    EXPECT_FALSE(within_limits(joints, {0.0, 2.1}));
    EXPECT_FALSE(within_limits(joints, {0.0, std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_TRUE(within_limits(joints, {0.0, 0.0, 99.0})) << "a joint that it does not have";
    Joints unknown;
    unknown.count = 1;
    EXPECT_TRUE(within_limits(unknown, {99.0})) << "no limit is known";
    EXPECT_FALSE(within_limits(unknown, {std::numeric_limits<double>::infinity()}));
}

}  // namespace burin::devices
