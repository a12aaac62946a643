// SPDX-License-Identifier: MIT
#include "devices/haptic/simulated_wand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"
#include "tests/support/test_units.hpp"

namespace burin::devices {
namespace {

// A hand that does not hold: for the wand's own dynamics.
constexpr HandGrip kNoHand{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};

SimulatedHand hand_of(std::vector<HandPose> script, HandGrip grip = {}) {
    return *SimulatedHand::create(std::move(script), HandPath::straight, grip);
}

Quat turned(double angle_rad, const Vec3& axis) { return glm::angleAxis(angle_rad, glm::normalize(axis)); }

// The angle between two orientations.
double between(const Quat& a, const Quat& b) {
    const Quat q = glm::conjugate(a) * b;
    return 2.0 * std::atan2(glm::length(Vec3(q.x, q.y, q.z)), std::abs(q.w));
}

void let_tick(SimulatedWand& wand, int ticks, const DeviceWrench& wrench) {
    for (int i = 0; i < ticks; ++i) {
        wand.advance(kMs);
        static_cast<void>(wand.read());
        wand.write(wrench);
    }
}

}  // namespace

TEST(SimulatedWand, DescribesTheQuanserWand) {
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}));
    const DeviceDescription& device = wand.description();
    EXPECT_STREQ(device.name, "Quanser 5-DOF Haptic Wand");
    EXPECT_EQ(device.axis_max_force_N, Vec3(2.3, 2.1, 3.0));
    EXPECT_EQ(device.max_torque_Nm, Vec3(0.230, 0.0, 0.250));
    EXPECT_EQ(device.rate_Hz, 1000.0);
    EXPECT_GE(device.max_force_N, 3.0);
}

TEST(SimulatedWand, AConstantTorqueTurnsItInClosedForm) {
    // I w' = T - c - b w  ->  w = (T - c)/b (1 - exp(-b t/I)).
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}, kNoHand));
    const WandArm arm;
    const double net = 0.1 - arm.angular_friction_Nm;
    wand.write({Vec3(0.0), {0.0, 0.0, 0.1}});
    wand.advance(kMs);  // from here on the torque acts
    for (int i = 0; i < 60; ++i) {
        wand.advance(kMs);
        const double t = 1e-3 * (i + 1), rate = arm.angular_damping_Nms_per_rad / arm.inertia_kgm2;
        const double w = net / arm.angular_damping_Nms_per_rad * (1.0 - std::exp(-rate * t));
        const double angle = net / arm.angular_damping_Nms_per_rad * (t - (1.0 - std::exp(-rate * t)) / rate);
        // First order in the 50 us step.
        EXPECT_NEAR(wand.true_turning_device_rad_per_s().z, w, 1e-3 * w + 1e-9);
        EXPECT_NEAR(between(Quat(1, 0, 0, 0), wand.true_pose_device().orientation), angle,
                    25e-6 * w + 1e-3 * angle + 1e-9);
    }
    EXPECT_LT(std::abs(wand.true_turning_device_rad_per_s().x), 1e-12);
}

TEST(SimulatedWand, AHandThatGripsGivesWayToATorqueByItsStiffness) {
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}));
    const double torque = 0.2;
    let_tick(wand, 1000, {Vec3(0.0), {torque, 0.0, 0.0}});
    const double angle = between(Quat(1, 0, 0, 0), wand.true_pose_device().orientation);
    // At rest the grip bears the torque, but for what friction bears; twice the sine of half the angle is 0.1.
    const double friction = WandArm{}.angular_friction_Nm;
    EXPECT_NEAR(2.0 * std::sin(0.5 * angle), torque / HandGrip{}.torsion_Nm_per_rad,
                friction / HandGrip{}.torsion_Nm_per_rad);
    EXPECT_GT(wand.read().orientation_device.x, 0.04);
    EXPECT_EQ(wand.true_turning_device_rad_per_s(), Vec3(0.0));
}

TEST(SimulatedWand, FollowsTheHandsTurnsAndWay) {
    const Quat there = turned(0.8, {1.0, 0.3, -0.4});
    SimulatedWand wand(
        hand_of({{0.0, Vec3(0.0)}, {2.0, {0.05, -0.03, 0.04}, there}, {2.5, {0.05, -0.03, 0.04}, there}}));
    let_tick(wand, 2500, {});
    EXPECT_LT(between(wand.read().orientation_device, there), 0.015) << "friction over the grip's stiffness";
    EXPECT_LT(glm::length(wand.read().position_device_m - Vec3(0.05, -0.03, 0.04)), 0.003);
}

TEST(SimulatedWand, GivesNoTorqueAboutThePassiveAxis) {
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}, kNoHand));
    let_tick(wand, 20, {Vec3(0.0), {0.0, 5.0, 0.0}});
    EXPECT_FALSE(wand.tripped());
    EXPECT_EQ(wand.true_pose_device().orientation, Quat(1, 0, 0, 0));
}

TEST(SimulatedWand, AmplifiersTripBeyondAnyLimitUntilTheyAreEnabledAgain) {
    const std::vector<DeviceWrench> beyond{{{2.31, 0, 0}, Vec3(0.0)},    {{0, -2.11, 0}, Vec3(0.0)},
                                           {{0, 0, 3.01}, Vec3(0.0)},    {Vec3(0.0), {-0.231, 0, 0}},
                                           {Vec3(0.0), {0, 0, 0.251}},   {{NAN, 0, 0}, Vec3(0.0)},
                                           {Vec3(0.0), {INFINITY, 0, 0}}};
    const DeviceWrench good{{1.0, 0.0, 0.0}, Vec3(0.0)};
    for (const DeviceWrench& wrench : beyond) {
        SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}));
        let_tick(wand, 5, good);
        EXPECT_EQ(wand.acting_wrench().force_device_N.x, 1.0);
        EXPECT_EQ(wand.read().fault, DeviceFault::none);
        wand.write(wrench);
        EXPECT_TRUE(wand.tripped());
        EXPECT_EQ(wand.acting_wrench().force_device_N, Vec3(0.0)) << "at once";
        let_tick(wand, 5, good);
        EXPECT_EQ(wand.acting_wrench().force_device_N, Vec3(0.0)) << "and for long";
        EXPECT_EQ(wand.read().fault, DeviceFault::other);
        EXPECT_EQ(wand.switch_amplifiers(true), AmplifierAnswer::done);
        EXPECT_EQ(wand.read().fault, DeviceFault::none);
        EXPECT_EQ(wand.acting_wrench().force_device_N, Vec3(0.0)) << "what was written before is gone";
        let_tick(wand, 5, good);
        EXPECT_EQ(wand.acting_wrench().force_device_N.x, 1.0);
        EXPECT_EQ(wand.trips(), 1u);
    }
}

TEST(SimulatedWand, AmplifiersStayOffWhileTheirCauseLasts) {
    const DeviceWrench good{{1.0, 0.0, 0.0}, Vec3(0.0)}, beyond{{9.0, 0.0, 0.0}, Vec3(0.0)};
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}));
    let_tick(wand, 5, beyond);
    EXPECT_TRUE(wand.tripped());
    EXPECT_EQ(wand.switch_amplifiers(true), AmplifierAnswer::cause_remains) << "they would trip again at once";
    EXPECT_TRUE(wand.tripped());
    let_tick(wand, 1, good);
    wand.lose_connection(true);
    EXPECT_EQ(wand.switch_amplifiers(true), AmplifierAnswer::cause_remains);
    wand.lose_connection(false);
    EXPECT_EQ(wand.switch_amplifiers(true), AmplifierAnswer::done);
    let_tick(wand, 5, good);
    EXPECT_EQ(wand.acting_wrench().force_device_N.x, 1.0);
}

// Else the gate would go on with the force that it gave before.
TEST(SimulatedWand, AmplifiersThatWereOffForLessThanATickAreToldOf) {
    const DeviceWrench good{{1.0, 0.0, 0.0}, Vec3(0.0)};
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}));
    let_tick(wand, 5, good);
    EXPECT_EQ(wand.switch_amplifiers(false), AmplifierAnswer::done);
    EXPECT_EQ(wand.switch_amplifiers(true), AmplifierAnswer::done);
    EXPECT_EQ(wand.read().fault, DeviceFault::other);
    EXPECT_EQ(wand.acting_wrench().force_device_N, Vec3(0.0));
    EXPECT_EQ(wand.read().fault, DeviceFault::none);
    EXPECT_EQ(wand.trips(), 0u) << "nothing tripped";
}

TEST(SimulatedWand, CountsTheTicksInWhichAnAxisIsAtItsLimit) {
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}));
    let_tick(wand, 3, {{2.3, 0.0, 0.0}, Vec3(0.0)});
    let_tick(wand, 2, {{0.0, -2.1 * (1.0 - 1e-15), 0.0}, {0.0, 0.0, 0.25}});
    let_tick(wand, 4, {{2.2, 2.0, 2.9}, {0.22, 0.0, 0.24}});
    EXPECT_FALSE(wand.tripped());
    EXPECT_EQ(wand.saturation().force, (std::array<std::uint64_t, 3>{3, 2, 0}));
    EXPECT_EQ(wand.saturation().torque, (std::array<std::uint64_t, 3>{0, 0, 2}));
}

TEST(SimulatedWand, StopsAtTheEndsOfItsBoxAndOfItsTurns) {
    const double pitch = 65.0 * kDegree_rad, roll = 85.0 * kDegree_rad;
    SimulatedWand far(hand_of({{0.0, Vec3(0.0)}, {1.0, {0.5, -0.5, 0.5}, turned(1.4, {1, 0, 0})}}));
    let_tick(far, 3000, {});
    const Vec3 half = 0.5 * far.description().workspace_m;
    EXPECT_EQ(far.true_pose_device().position_m, Vec3(half.x, -half.y, half.z));
    const double angle = between(Quat(1, 0, 0, 0), far.true_pose_device().orientation);
    EXPECT_LE(angle, pitch + 1e-12);
    EXPECT_GT(angle, pitch - 0.02) << "the last step before the stop";
    SimulatedWand rolled(hand_of({{0.0, Vec3(0.0)}, {1.0, Vec3(0.0), turned(-1.55, {0, 0, 1})}}));
    let_tick(rolled, 3000, {});
    const double rolled_by = between(Quat(1, 0, 0, 0), rolled.true_pose_device().orientation);
    EXPECT_LE(rolled_by, roll + 1e-12);
    EXPECT_GT(rolled_by, roll - 0.02);
    // About its own axis it turns freely.
    SimulatedWand spun(hand_of({{0.0, Vec3(0.0)}, {1.0, Vec3(0.0), turned(2.0, {0, 1, 0})}}));
    let_tick(spun, 2500, {});
    EXPECT_NEAR(between(Quat(1, 0, 0, 0), spun.true_pose_device().orientation), 2.0, 0.02);
}

TEST(SimulatedWand, BeginsWithinItsStops) {
    SimulatedWand wand(hand_of({{0.0, {1.0, 0.0, 0.0}, turned(1.5, {1, 0, 0})}}));
    EXPECT_DOUBLE_EQ(wand.read().position_device_m.x, 0.24);
    EXPECT_EQ(wand.read().orientation_device, Quat(1, 0, 0, 0));
}

TEST(SimulatedWand, ReadsInStepsOfItsEncoders) {
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}, {1.0, {0.02, 0.01, -0.02}, turned(0.5, {1.0, 2.0, -1.0})}}));
    const WandArm arm;
    for (int i = 0; i < 1000; ++i) {
        wand.advance(kMs);
        const DeviceSample sample = wand.read();
        const Pose& truth = wand.true_pose_device();
        EXPECT_LE(between(sample.orientation_device, truth.orientation), 0.9 * arm.orientation_step_rad);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_LE(std::abs(sample.position_device_m[axis] - truth.position_m[axis]), 0.500001 * arm.resolution_m);
        EXPECT_NEAR(glm::length(sample.orientation_device), 1.0, 1e-12);
    }
}

TEST(SimulatedWand, TheSameScriptGivesTheSameBitsByAdvanceAndByClock) {
    const std::vector<HandPose> script{{0.0, Vec3(0.0)}, {0.5, {0.05, 0.02, -0.04}, turned(0.6, {1.0, -0.5, 0.2})}};
    SimulatedClock clock;
    SimulatedWand stepped(hand_of(script)), clocked(hand_of(script), {}, &clock);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> some(-1.0, 1.0);
    for (int i = 1; i <= 600; ++i) {
        stepped.advance(kMs);
        clock.sleep_until(i * kMs);
        const DeviceSample a = stepped.read(), b = clocked.read();
        ASSERT_EQ(a.position_device_m, b.position_device_m) << i;
        ASSERT_EQ(a.orientation_device, b.orientation_device) << i;
        ASSERT_EQ(a.time_ns, b.time_ns) << i;
        const double fx = some(random), fz = some(random), tx = 0.2 * some(random), tz = 0.2 * some(random);
        const DeviceWrench wrench{{fx, 0.0, fz}, {tx, 0.0, tz}};
        stepped.write(wrench);
        clocked.write(wrench);
    }
}

TEST(SimulatedWand, ALostConnectionTakesTheForceWithIt) {
    SimulatedWand wand(hand_of({{0.0, Vec3(0.0)}}));
    let_tick(wand, 5, {{1.0, 0.0, 0.0}, Vec3(0.0)});
    wand.lose_connection(true);
    wand.advance(kMs);
    EXPECT_EQ(wand.read().fault, DeviceFault::disconnected);
    EXPECT_EQ(wand.acting_wrench().force_device_N, Vec3(0.0));
}

TEST(SimulatedWand, IsInTheRegistryAlsoWithADescription) {
    SimulatedClock clock;
    const auto host = [&] { return HapticHost{clock, hand_of({{0.0, Vec3(0.0)}})}; };
    const auto plain = open_haptic_device("simulated-wand", host());
    ASSERT_TRUE(plain) << plain.error().line();
    EXPECT_EQ(plain->parts.front().device->description().max_torque_Nm, Vec3(0.230, 0.0, 0.250));
    EXPECT_NE(plain->amplifiers, nullptr);
    const auto described = open_haptic_device("simulated-wand:assets/devices/quanser-wand.toml", host());
    ASSERT_TRUE(described) << described.error().line();
    EXPECT_STREQ(described->parts.front().device->description().name, "Quanser 5-DOF Haptic Wand");
    const auto missing = open_haptic_device("simulated-wand:no-such.toml", host());
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().line().find("no-such.toml"), std::string::npos);
    EXPECT_FALSE(open_haptic_device("simulated:w.toml", host())) << "the Omni has no description";
}

TEST(SimulatedWand, FollowsADirectedHandAndIsPushedAwayFromOneThatGivesWay) {
    HandDirection direction;
    direction.target.position_device_m = {0.05, 0.0, 0.0};
    SimulatedWand wand((DirectedHand(direction)));
    EXPECT_EQ(wand.read().position_device_m, direction.target.position_device_m);
    // Goes on with the target's velocity, from when the direction says.
    direction.since_s = 0.0;
    direction.target.velocity_device_m_per_s = {0.1, 0.0, 0.0};
    wand.advance(1000 * kMs);
    EXPECT_NEAR(wand.true_velocity_device_m_per_s().x, 0.1, 1e-3);
    EXPECT_GT(wand.true_pose_device().position_m.x, 0.14);
    // A hand that gives way goes where it is pushed: F = (B + b) v + friction.
    direction.target.velocity_device_m_per_s = Vec3(0.0);
    direction.grip = kNoHand;
    direction.grip.mass_kg = 0.1;
    direction.grip.damping_Ns_per_m = 6.0;
    wand.write({{0.0, 0.0, 1.0}, {}});
    wand.advance(1000 * kMs);
    const WandArm arm;
    EXPECT_NEAR(wand.true_velocity_device_m_per_s().z, (1.0 - arm.friction_N) / (6.0 + arm.damping_Ns_per_m), 1e-3);
}

}  // namespace burin::devices
