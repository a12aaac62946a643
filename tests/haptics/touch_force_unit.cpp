// SPDX-License-Identifier: MIT
#include "haptics/forces/touch_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "haptics/tick.hpp"
#include "tests/haptics/cutting_ball.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

TouchInput resting(const Vec3& hip, const Vec3& velocity = Vec3(0.0)) {
    TouchInput in;
    in.hip_object_m = hip;
    in.bearing_object_m = {hip.x, 0.0, hip.z};
    in.normal_object = {0.0, 1.0, 0.0};
    in.velocity_device_m_per_s = velocity;
    in.stiffness_N_per_m = 500.0;
    in.damping_Ns_per_m = 2.0;
    return in;
}

struct TouchTicker {
    const geometry::LocalSurface* surface;
    TickParameters parameters;
    TickState state{};
    Nanoseconds now_ns = 0;

    TickRecord at(const Vec3& position, std::uint32_t buttons = 0) {
        now_ns += kMs;
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        sample.position_device_m = position;
        sample.buttons = buttons;
        const Tick t = tick(state, sample, *surface, parameters, test::kStrongDevice, now_ns, kDt);
        state = t.next;
        return t.record;
    }
};

TickParameters ball(double stiffness) {
    TickParameters p;
    p.probe = ball_probe(0.004);
    p.clearance_ratio = 0.0;
    p.limit_stiffness = false;
    p.passivity.control = false;
    p.materials[0].stiffness_N_per_m = stiffness;
    p.materials[0].damping_Ns_per_m = 0.0;
    p.max_surface_age_s = 0.0;
    return p;
}

}  // namespace

TEST(TouchForce, IsSpringAndDamperAlongTheNormal) {
    const Vec3 force = touch_force_device(resting({0.0, -0.002, 0.0}, {0.3, -0.05, 0.7}));
    EXPECT_NEAR(force.x, 0.0, 1e-15);
    EXPECT_NEAR(force.y, 500.0 * 0.002 + 2.0 * 0.05, 1e-12);  // motion across the normal is not damped
    EXPECT_NEAR(force.z, 0.0, 1e-15);
}

TEST(TouchForce, TheDamperNeverPullsIntoTheSurface) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        TouchInput in =
            resting({0.0, -0.003 * std::abs(any(random)), 0.0}, Vec3(any(random), any(random), any(random)));
        in.damping_Ns_per_m = 10.0 * std::abs(any(random));
        const Quat turn = glm::normalize(Quat(any(random), any(random), any(random), any(random)));
        in.object_from_device_orientation = turn;
        const double along = glm::dot(turn * touch_force_device(in), in.normal_object);
        const double speed = glm::dot(turn * in.velocity_device_m_per_s, in.normal_object);
        EXPECT_GE(along, -1e-12);
        EXPECT_NEAR(along, std::max(0.0, -500.0 * in.hip_object_m.y - in.damping_Ns_per_m * speed), 1e-9);
    }
}

TEST(TouchForce, WhatFrictionHoldsBackIsFeltAcrossTheNormal) {
    TouchInput in = resting({0.0, -0.002, 0.0});
    in.bearing_object_m = {-0.001, 0.0, 0.0005};  // the proxy stuck behind
    const Vec3 force = touch_force_device(in);
    EXPECT_NEAR(force.x, -0.5, 1e-12);
    EXPECT_NEAR(force.y, 1.0, 1e-12);
    EXPECT_NEAR(force.z, 0.25, 1e-12);
}

TEST(TouchForce, AGainDividesLengthsOnTheirWayToTheDevice) {
    const Vec3 unscaled = touch_force_device(resting({0.0, -0.002, 0.0}, {0.0, -0.1, 0.0}));
    TouchInput in = resting(30.0 * Vec3(0.0, -0.002, 0.0), {0.0, -0.1, 0.0});
    in.scale = 30.0;
    EXPECT_LT(glm::length(touch_force_device(in) - unscaled), 1e-12);
}

TEST(TouchForce, FrictionHasAConeOrGrowsWithTheSlipSpeedUpToTheCoulombVelocity) {
    TouchMaterial material;
    material.static_friction = 0.5;
    material.dynamic_friction = 0.3;
    for (const double speed : {0.0, 0.01, 1.0}) {
        EXPECT_EQ(friction_at(material, speed).static_friction, 0.5);
        EXPECT_EQ(friction_at(material, speed).dynamic_friction, 0.3);
    }
    material.coulomb_velocity_m_per_s = 0.02;
    for (const double speed : {0.0, 0.005, 0.02, 0.5}) {
        const FrictionCone cone = friction_at(material, speed);
        EXPECT_NEAR(cone.dynamic_friction, 0.3 * std::min(1.0, speed / 0.02), 1e-15);
        EXPECT_EQ(cone.static_friction, cone.dynamic_friction);  // nothing sticks
    }
}

TEST(TouchForce, InTheTickFrictionWithACoulombVelocityFollowsTheSlipSpeed) {
    const test::Surface plane = test::plane(0.05, 20);
    for (const double speed : {0.005, 0.01, 0.02, 0.05}) {
        TouchTicker t{plane.get(), ball(600.0)};
        t.parameters.materials[0].static_friction = t.parameters.materials[0].dynamic_friction = 0.4;
        t.parameters.materials[0].coulomb_velocity_m_per_s = 0.02;
        t.parameters.position_noise_m = 1e-9;
        t.at({-0.03, 0.01, 0.0});
        TickRecord out;
        for (int i = 0; i < 600; ++i) out = t.at({-0.03 + speed * kDt * i, 0.003, 0.0});
        const double mu = 0.4 * std::min(1.0, speed / 0.02);
        EXPECT_NEAR(-out.wanted.force_device_N.x / out.wanted.force_device_N.y, mu, 0.02 * mu + 1e-3) << speed;
    }
}

TEST(TouchForce, PressingStraightInDoesNotRaiseTheFrictionOfACoulombVelocity) {
    const test::Surface plane = test::plane(0.05, 20);
    TouchTicker t{plane.get(), ball(600.0)};
    t.parameters.materials[0].static_friction = t.parameters.materials[0].dynamic_friction = 0.4;
    t.parameters.materials[0].coulomb_velocity_m_per_s = 0.2;
    t.parameters.position_noise_m = 1e-9;
    t.at({-0.03, 0.01, 0.0});
    TickRecord out;  // slides at 20 mm/s and comes down at 60 mm/s
    for (int i = 0; i < 50; ++i) out = t.at({-0.03 + 0.02 * kDt * i, 0.004 - 0.06 * kDt * i, 0.0});
    EXPECT_NEAR(-out.wanted.force_device_N.x / out.wanted.force_device_N.y, 0.04, 0.01) << "0.4 times a tenth";
}

TEST(TouchForce, ACoulombVelocityThatIsGivenUnderTheHandChangesTheForceInSmallSteps) {
    const test::Surface plane = test::plane(0.05, 20);
    TouchTicker t{plane.get(), ball(600.0)};
    t.parameters.materials[0].static_friction = t.parameters.materials[0].dynamic_friction = 0.4;
    t.parameters.position_noise_m = 1e-9;
    t.at({-0.03, 0.01, 0.0});
    TickRecord out;
    const auto slides = [&](int i) { return t.at({-0.03 + 0.01 * kDt * i, 0.003, 0.0}); };
    for (int i = 0; i < 600; ++i) out = slides(i);
    const double before_N = out.wanted.force_device_N.x;
    t.parameters.materials[0].coulomb_velocity_m_per_s = 0.1;
    double largest_N = 0.0, last_N = before_N;
    for (int i = 600; i < 700; ++i) {
        out = slides(i);
        largest_N = std::max(largest_N, std::abs(out.wanted.force_device_N.x - last_N));
        last_N = out.wanted.force_device_N.x;
    }
    EXPECT_LT(std::abs(last_N), 0.2 * std::abs(before_N));
    EXPECT_LT(largest_N, 3.0 * std::abs(before_N) / 50.0);
}

TEST(TouchForce, AMaterialMayChangeWhileTheLoopRuns) {
    const test::Surface plane = test::plane();
    TouchTicker t{plane.get(), ball(300.0)};
    t.at({0.0, 0.01, 0.0});
    const auto pressed_N = [&](int ticks) {
        for (int i = 1; i < ticks; ++i) static_cast<void>(t.at({0.0, 0.003, 0.0}));
        return t.at({0.0, 0.003, 0.0}).wanted.force_device_N.y;
    };
    const int eased = static_cast<int>(kEase_s / kDt) + 1;
    EXPECT_NEAR(pressed_N(1), 0.3, 1e-5);
    t.parameters.materials[0].stiffness_N_per_m = 900.0;
    EXPECT_NEAR(pressed_N(1), 0.3 + 0.6 * kDt / kEase_s, 1e-5);
    EXPECT_NEAR(pressed_N(eased), 0.9, 1e-5);
    t.parameters.materials[0].enabled = false;
    EXPECT_NEAR(pressed_N(1), 0.9 * (1.0 - kDt / kEase_s), 1e-5);
    EXPECT_EQ(t.at({0.0, 0.003, 0.0}).flags & kTickInContact, 0u);
    EXPECT_EQ(pressed_N(eased), 0.0);
    t.parameters.materials[0].enabled = true;
    EXPECT_NEAR(pressed_N(1), 0.9 * kDt / kEase_s, 1e-5);
    EXPECT_NEAR(pressed_N(eased), 0.9, 1e-5);
}

TEST(TouchForce, WhileItCutsTheHandFeelsLessThanTheUncutWallAndTheStrokeSaysWhereItIs) {
    const test::Surface plane = test::plane(0.05, 40);
    TouchTicker t{plane.get(), ball(600.0)};
    t.parameters.action = ToolAction::cut;
    t.parameters.tool = test::ball_tool(0.004);
    t.parameters.materials[0].hardness_Ns_per_m3 = 1e7;
    t.at({0.0, 0.01, 0.0}, 1);
    TickRecord out = t.at({0.0, 0.002, 0.0}, 0);
    EXPECT_EQ(out.flags & kTickCutting, 0u);
    EXPECT_NEAR(out.wanted.force_device_N.y, 1.2, 1e-4);
    EXPECT_EQ(out.contact.cut_object_m, out.contact.points[0].proxy_object_m);
    double last = 1.2, depth = 0.0;
    for (int i = 0; i < 100; ++i) {
        out = t.at({0.0, 0.002, 0.0}, 1);
        EXPECT_NE(out.flags & kTickCutting, 0u);
        EXPECT_LT(out.wanted.force_device_N.y, last);
        EXPECT_NEAR(out.wanted.force_device_N.y, 600.0 * (out.contact.cut_object_m.y - 0.002), 1e-6);
        last = out.wanted.force_device_N.y;
        depth = 0.004 - out.contact.cut_object_m.y;
    }
    EXPECT_GT(depth, 2e-4);
    EXPECT_LT(depth, 0.002);
    t.parameters.materials[0].hardness_Ns_per_m3 = std::numeric_limits<double>::infinity();
    out = t.at({0.0, 0.002, 0.0}, 1);
    EXPECT_TRUE(out.parameters_sensible);
    EXPECT_EQ(out.flags & kTickCutting, 0u);
    EXPECT_NEAR(out.wanted.force_device_N.y, 1.2, 1e-4);
}

TEST(TouchForce, PaintingHasNoFriction) {
    const test::Surface plane = test::plane(0.05, 20);
    for (const ToolAction action : {ToolAction::touch, ToolAction::paint}) {
        TouchTicker t{plane.get(), ball(600.0)};
        t.parameters.action = action;
        t.parameters.materials[0].static_friction = t.parameters.materials[0].dynamic_friction = 0.4;
        t.at({-0.03, 0.01, 0.0}, 1);
        TickRecord out;
        for (int i = 0; i < 300; ++i) out = t.at({-0.03 + 1e-4 * i, 0.003, 0.0}, 1);
        const double ratio = -out.wanted.force_device_N.x / out.wanted.force_device_N.y;
        EXPECT_NEAR(ratio, action == ToolAction::paint ? 0.0 : 0.4, 0.01);
    }
}

TEST(TouchForce, AHeldToolWeighsWhatItWeighsAndTheArmDoesNot) {
    WeightSettings weight;
    weight.tool_mass_kg = 0.1;
    weight.compensated_mass_kg = 0.045;
    weight.tool_centre_of_mass_device_m = {0.0, 0.0, 0.05};
    const Quat level(1.0, 0.0, 0.0, 0.0);
    devices::DeviceWrench w = weight_wrench(weight, level);
    EXPECT_LT(glm::length(w.force_device_N - Vec3(0.0, -(0.1 - 0.045) * 9.80665, 0.0)), 1e-12);
    // r x F = (0, 0, 0.05) x (0, -0.98, 0): the arm of the device bears at its own place and turns nothing.
    EXPECT_LT(glm::length(w.torque_device_Nm - Vec3(0.05 * 0.1 * 9.80665, 0.0, 0.0)), 1e-12);
    const double half = std::sqrt(0.5);
    w = weight_wrench(weight, Quat(half, -half, 0.0, 0.0));  // turned about x until it hangs straight up
    EXPECT_LT(glm::length(w.torque_device_Nm), 1e-12);
    EXPECT_EQ(weight_wrench({}, level).force_device_N, Vec3(0.0));
    // In free space, through the tick.
    const test::Surface plane = test::plane();
    TouchTicker t{plane.get(), ball(600.0)};
    t.parameters.weight = weight;
    EXPECT_NEAR(t.at({0.0, 0.03, 0.0}).wanted.force_device_N.y, -(0.1 - 0.045) * 9.80665, 1e-12);
}

}  // namespace burin::haptics
