// SPDX-License-Identifier: MIT
// What each part of a tick works out reaches the record, the next tick, and the gate.
#include <gtest/gtest.h>

#include <limits>

#include "haptics/tick.hpp"
#include "tests/haptics/cutting_ball.hpp"
#include "tests/haptics/surfaces.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

constexpr double kTipRadius_m = 0.004, kTipStiffness_N_per_m = 600.0;

TickParameters bare_parameters() {
    TickParameters p;
    p.probe = ball_probe(kTipRadius_m);
    p.clearance_ratio = 0.0;
    p.limit_stiffness = false;
    p.passivity.control = false;
    p.materials[0].stiffness_N_per_m = kTipStiffness_N_per_m;
    p.materials[0].damping_Ns_per_m = 0.0;
    p.max_surface_age_s = 0.0;
    return p;
}

struct PartTicker {
    test::Surface surface = test::plane(0.05, 40);
    TickParameters parameters = bare_parameters();
    TickState state{};
    Nanoseconds now_ns = 0;

    TickRecord at(const Vec3& position_device_m, std::uint32_t buttons = 0) {
        now_ns += kMs;
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        sample.position_device_m = position_device_m;
        sample.buttons = buttons;
        const Tick t = tick(state, sample, *surface, parameters, test::kStrongDevice, now_ns, kDt);
        state = t.next;
        return t.record;
    }
};

TEST(TickParts, ProxiesThatWereSetBeforeAWallHoldAHandThatIsBeyondItAndAreSetOnce) {
    PartTicker t;
    t.surface = test::box({-0.05, -0.01, -0.05}, {0.05, 0.0, 0.05}, 4);
    t.parameters.probe.count = 2;
    t.parameters.probe.points[1] = {{0.01, 0.0, 0.0}, kTipRadius_m};
    const Vec3 beyond(0.0, -0.02, 0.0);
    EXPECT_EQ(t.at(beyond).flags & kTickInContact, 0u);
    t.parameters.placement = {7, {0.0, 0.02, 0.0}};
    t.parameters.enabled = false;
    EXPECT_EQ(t.at(beyond).flags & kTickInContact, 0u);
    t.parameters.enabled = true;
    const TickRecord set = t.at(beyond);
    ASSERT_EQ(set.contact.point_count, 2u);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_GT(set.contact.points[i].proxy_object_m.y, 0.003) << i;
    EXPECT_NE(set.flags & kTickInContact, 0u);
    EXPECT_TRUE(set.contact.jumped) << "so that the gate fades the force in";
    EXPECT_FALSE(t.at(beyond).contact.jumped);
    t.at({0.0, 0.03, 0.0});
    EXPECT_EQ(t.at({0.0, 0.03, 0.0}).contact.points[0].proxy_object_m, Vec3(0.0, 0.03, 0.0));
    t.parameters.placement.position_object_m.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(parameters_are_sensible(t.parameters));
}

TEST(TickParts, TheForceFilterLetsATenthOfANewForceThroughInItsFirstTick) {
    PartTicker t;
    t.parameters.signals.force_alpha = 0.9;
    t.at({0.0, 0.01, 0.0});
    EXPECT_NEAR(t.at({0.0, 0.003, 0.0}).wanted.force_device_N.y, 0.1 * kTipStiffness_N_per_m * 0.001, 1e-6);
    EXPECT_NEAR(t.at({0.0, 0.003, 0.0}).wanted.force_device_N.y, 0.19 * kTipStiffness_N_per_m * 0.001, 1e-6);
}

TEST(TickParts, TheAveragedVelocityRisesToTheHandsByATenthOfTheRestATick) {
    PartTicker t;
    t.parameters.signals.velocity = VelocityMethod::moving_average;
    t.parameters.signals.velocity_alpha = 0.9;
    for (int i = 0; i < 3; ++i) t.at({0.0, 0.02, 0.0});
    double expected = 0.0;
    for (int i = 1; i < 20; ++i) {
        expected = 0.9 * expected + 0.1 * 0.1;  // 0.1 m/s
        EXPECT_NEAR(t.at({1e-4 * i, 0.02, 0.0}).motion.velocity_device_m_per_s.x, expected, 1e-9) << i;
    }
}

TEST(TickParts, GuidanceLeadsOnFromTickToTick) {
    PartTicker t;
    t.parameters.guidance.stiffness_N_per_m = 100.0;
    t.parameters.guidance.lead_speed_m_per_s = 0.05;
    t.parameters.curve.count = 2;
    t.parameters.curve.points_object_m[0] = {0.0F, 0.02F, 0.0F};
    t.parameters.curve.points_object_m[1] = {0.03F, 0.02F, 0.0F};
    TickRecord out;
    for (int i = 0; i < 101; ++i) out = t.at({0.0, 0.02, 0.0});
    EXPECT_NE(out.flags & kTickGuided, 0u);
    // After 100 ms the attracting point is 5 mm ahead.
    EXPECT_NEAR(out.wanted.force_device_N.x, 100.0 * 0.005, 100.0 * 0.0001);
}

TEST(TickParts, TheSpringsOfAllPointsHoldEnergy) {
    PartTicker t;
    t.parameters.probe.count = 2;
    t.parameters.probe.points[0] = {{0.01, 0.0, 0.0}, kTipRadius_m};
    t.parameters.probe.points[1] = {{-0.01, -0.0005, 0.0}, kTipRadius_m};
    t.at({0.0, 0.01, 0.0});
    const TickRecord out = t.at({0.0, 0.003, 0.0});
    const double first_J = 0.5 * kTipStiffness_N_per_m * 0.001 * 0.001;
    const double second_J = 0.5 * kTipStiffness_N_per_m * 0.0015 * 0.0015;
    EXPECT_NEAR(out.contact.spring_energy_J, first_J + second_J, 1e-3 * second_J);
}

TEST(TickParts, WhereNothingIsTouchedTheCuttingPointIsWhereTheHandIs) {
    for (const bool enabled : {true, false}) {  // in free space, and inside material that is not felt
        PartTicker t;
        t.parameters.enabled = enabled;
        const Vec3 hand(0.001, enabled ? 0.02 : -0.02, 0.003);
        const TickRecord out = t.at(hand, 1);
        EXPECT_EQ(out.contact.cut_object_m, hand) << enabled;
        EXPECT_EQ(out.contact.points[0].proxy_object_m, hand) << enabled;
    }
}

// Two hands do the same but for what a cut adds; they press the button in their last tick, while the contact is the
// same in both.
struct Pair {
    PartTicker without, with;

    Pair() {
        for (PartTicker* t : {&without, &with}) {
            t->parameters.action = ToolAction::cut;
            t->parameters.tool = test::ball_tool(kTipRadius_m);
            t->parameters.materials[0].hardness_Ns_per_m3 = 1e7;
            t->at({-0.001, 0.01, 0.0});
        }
    }
    void slide(std::uint32_t buttons_without, std::uint32_t buttons_with, TickRecord& a, TickRecord& b) {
        for (int i = 0; i < 20; ++i) {
            const Vec3 at(-0.001 + 1e-4 * i, 0.003, 0.0);
            a = without.at(at, i == 19 ? buttons_without : 0);
            b = with.at(at, i == 19 ? buttons_with : 0);
        }
    }
};

TEST(TickParts, WhatACutLooksAtCountsAsWork) {
    Pair pair;
    TickRecord felt, cut;
    pair.slide(0, 1, felt, cut);
    EXPECT_EQ(felt.contact.work.triangles_tested, cut.contact.work.triangles_tested);
    EXPECT_GT(cut.contact.work.triangles_seen, felt.contact.work.triangles_seen);
}

TEST(TickParts, ACutsDragActsAgainstTheMotionOfTheHand) {
    Pair pair;
    pair.with.parameters.materials[0].cutting_drag_Ns_per_m3 = 1e6;
    TickRecord free, dragged;
    pair.slide(1, 1, free, dragged);
    ASSERT_NE(dragged.flags & kTickCutting, 0u);
    ASSERT_NEAR(dragged.motion.velocity_device_m_per_s.x, 0.1, 1e-9);
    const Vec3 drag = dragged.wanted.force_device_N - free.wanted.force_device_N;
    EXPECT_LT(drag.x, -0.01);
    EXPECT_NEAR(drag.y, 0.0, 1e-9);
    EXPECT_NEAR(drag.z, 0.0, 1e-9);
}

TEST(TickParts, TheGateIsToldAllThatTheTickFound) {
    TickRecord record;
    record.time_ns = 30 * kMs;
    record.sample.time_ns = 10 * kMs;
    record.wanted = {{1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}};
    record.motion.velocity_device_m_per_s = {4.0, 5.0, 6.0};
    devices::DeviceDescription device = test::kStrongDevice;
    device.max_force_N = 7.0;
    device.axis_max_force_N = {8.0, 9.0, 10.0};
    device.max_torque_Nm = {0.4, 0.5, 0.6};
    const GateInput all_well = gate_input(record, device);
    EXPECT_EQ(all_well.wanted.force_device_N, Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(all_well.wanted.torque_device_Nm, Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(all_well.velocity_device_m_per_s, Vec3(4.0, 5.0, 6.0));
    EXPECT_EQ(all_well.device_max_force_N, 7.0);
    EXPECT_EQ(all_well.device_axis_max_force_N, Vec3(8.0, 9.0, 10.0));
    EXPECT_EQ(all_well.device_max_torque_Nm, Vec3(0.4, 0.5, 0.6));
    EXPECT_NEAR(all_well.sample_age_s, 0.02, 1e-12);
    EXPECT_EQ(all_well.device_fault, devices::DeviceFault::none);
    EXPECT_TRUE(all_well.sample_finite && all_well.parameters_sensible);
    EXPECT_FALSE(all_well.in_contact || all_well.contact_jumped || all_well.surface_stale || all_well.outside_known);

    const auto told = [&](auto change) {
        TickRecord changed = record;
        change(changed);
        return gate_input(changed, device);
    };
    EXPECT_FALSE(told([](TickRecord& r) { r.sample_finite = false; }).sample_finite);
    EXPECT_FALSE(told([](TickRecord& r) { r.parameters_sensible = false; }).parameters_sensible);
    EXPECT_TRUE(told([](TickRecord& r) { r.flags = kTickInContact; }).in_contact);
    EXPECT_TRUE(told([](TickRecord& r) { r.contact.jumped = true; }).contact_jumped);
    EXPECT_TRUE(told([](TickRecord& r) { r.flags = kTickStaleSurface; }).surface_stale);
    EXPECT_TRUE(told([](TickRecord& r) { r.flags = kTickOutsideKnown; }).outside_known);
    const auto fault = devices::DeviceFault::disconnected;
    EXPECT_EQ(told([&](TickRecord& r) { r.sample.fault = fault; }).device_fault, fault);
}

}  // namespace
}  // namespace burin::haptics
