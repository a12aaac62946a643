// SPDX-License-Identifier: MIT
#include "haptics/stability/safety_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "haptics/tick.hpp"
#include "tests/support/test_units.hpp"

namespace burin::haptics {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

GateInput asking_for(const Vec3& force) {
    GateInput in;
    in.wanted.force_device_N = force;
    in.device_max_force_N = 3.3;
    return in;
}

// A gate that has been open for long.
GateState open_at(const Vec3& force) { return {.given = {force}, .ramp = 1.0, .well_s = 10.0}; }

}  // namespace

TEST(SafetyGate, PassesAModestForceUnchanged) {
    const Vec3 force(0.3, -0.2, 1.0);
    const GateStep out = pass_gate(open_at(force), asking_for(force), {}, kDt);
    EXPECT_EQ(out.output.given.force_device_N, force);
    EXPECT_EQ(out.output.cause, GateCause::none);
    EXPECT_FALSE(out.output.saturated || out.output.slew_limited || out.output.ramping);
}

TEST(SafetyGate, FadesInFromZeroAtTheStart) {
    GateState state;
    const GateLimits limits{.ramp_s = 0.2};
    double last = 0.0;
    for (int i = 1; i <= 250; ++i) {
        const GateStep out = pass_gate(state, asking_for({1.0, 0.0, 0.0}), limits, kDt);
        EXPECT_NEAR(out.output.given.force_device_N.x, std::min(1.0, i / 200.0), 1e-9);
        EXPECT_GE(out.output.given.force_device_N.x, last);
        EXPECT_EQ(out.output.ramping, i < 200) << i;
        last = out.output.given.force_device_N.x;
        state = out.next;
    }
}

TEST(SafetyGate, CutsToTheSmallerOfDeviceAndSettingAndKeepsTheDirection) {
    const Vec3 big(30.0, 40.0, 0.0);
    GateStep out = pass_gate(open_at({1.98, 2.64, 0}), asking_for(big), {}, kDt);
    EXPECT_TRUE(out.output.saturated);
    EXPECT_NEAR(out.output.given.force_device_N.x, 1.98, 1e-12);
    EXPECT_NEAR(out.output.given.force_device_N.y, 2.64, 1e-12);
    out = pass_gate(open_at({0.6, 0.8, 0}), asking_for(big), {.max_force_N = 1.0}, kDt);
    EXPECT_NEAR(glm::length(out.output.given.force_device_N), 1.0, 1e-12);
}

TEST(SafetyGate, ForceLimitWinsOverSlewLimitWhenItIsLowered) {
    const GateLimits limits{.max_force_N = 0.5, .max_slew_N_per_s = 100.0};
    const GateStep out = pass_gate(open_at({3.0, 0.0, 0.0}), asking_for({3.0, 0.0, 0.0}), limits, kDt);
    EXPECT_LE(glm::length(out.output.given.force_device_N), 0.5);
}

TEST(SafetyGate, ALoopThatStoodStillIsALossWhetherForceOrTorqueWasHeld) {
    const Vec3 force_N(0.3, -0.2, 0.5), torque_Nm(0.02, 0.05, -0.03);
    for (const bool has_force : {false, true})
        for (const bool has_torque : {false, true}) {
            GateState state{.given = {}, .ramp = 1.0, .well_s = 10.0};
            if (has_force) state.given.force_device_N = force_N;
            if (has_torque) state.given.torque_device_Nm = torque_Nm;
            GateInput in = asking_for(force_N);
            in.wanted.torque_device_Nm = torque_Nm;
            in.device_max_torque_Nm = Vec3(1.0);
            in.most_torque_Nm = 1.0;
            in.loop_gap_s = 0.1;
            const GateStep out = pass_gate(state, in, {}, kDt);
            EXPECT_EQ(out.output.cause, has_force || has_torque ? GateCause::lost_loop : GateCause::none)
                << has_force << has_torque;
        }
}

TEST(SafetyGate, EveryCauseGivesZeroAtOnceAndItsOwnName) {
    struct Case {
        GateCause cause;
        void (*spoil)(GateInput&, GateLimits&);
    };
    const Case cases[] = {
        {GateCause::device_fault,
         [](GateInput& in, GateLimits&) { in.device_fault = devices::DeviceFault::overheated; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.wanted.force_device_N.y = kNan; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.wanted.force_device_N.y = kInfinity; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.wanted.force_device_N.y = 1e300; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.velocity_device_m_per_s.z = kNan; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.sample_age_s = kNan; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.device_max_force_N = kNan; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.sample_finite = false; }},
        {GateCause::bad_parameters, [](GateInput& in, GateLimits&) { in.parameters_sensible = false; }},
        {GateCause::bad_parameters, [](GateInput&, GateLimits& l) { l.max_force_N = kNan; }},
        {GateCause::bad_parameters, [](GateInput&, GateLimits& l) { l.max_slew_N_per_s = -1.0; }},
        {GateCause::bad_scale, [](GateInput& in, GateLimits&) { in.scale_felt = false; }},
        {GateCause::stale_sample, [](GateInput& in, GateLimits&) { in.sample_age_s = 0.021; }},
        {GateCause::future_sample, [](GateInput& in, GateLimits&) { in.sample_age_s = -0.0051; }},
        {GateCause::out_of_reach, [](GateInput& in, GateLimits&) { in.within_reach = false; }},
        {GateCause::caught, [](GateInput& in, GateLimits&) { in.let_go = true; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.promised_gap_s = kNan; }},
        {GateCause::bad_parameters, [](GateInput&, GateLimits& l) { l.max_ahead_s = kNan; }},
        {GateCause::overspeed, [](GateInput& in, GateLimits&) { in.velocity_device_m_per_s.x = -3.1; }},
        {GateCause::stale_surface, [](GateInput& in, GateLimits&) { in.in_contact = in.surface_stale = true; }},
        {GateCause::outside_known, [](GateInput& in, GateLimits&) { in.in_contact = in.outside_known = true; }},
        {GateCause::lost_loop, [](GateInput& in, GateLimits&) { in.loop_gap_s = 0.021; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.loop_gap_s = kNan; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.wanted.torque_device_Nm.x = kInfinity; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.device_max_torque_Nm.z = kNan; }},
        {GateCause::not_finite, [](GateInput& in, GateLimits&) { in.device_axis_max_force_N.y = -1.0; }},
        {GateCause::bad_parameters, [](GateInput&, GateLimits& l) { l.contact_ramp_s = kInfinity; }},
        {GateCause::bad_parameters, [](GateInput&, GateLimits& l) { l.max_loop_gap_s = -0.1; }},
        {GateCause::bad_parameters, [](GateInput&, GateLimits& l) { l.max_torque_slew_Nm_per_s = kNan; }},
    };
    std::set<GateCause> seen;
    for (const Case& c : cases) {
        GateInput in = asking_for({1.0, 0.0, 0.0});
        GateLimits limits;
        c.spoil(in, limits);
        const GateStep out = pass_gate(open_at({1.0, 0.0, 0.0}), in, limits, kDt);
        EXPECT_EQ(out.output.cause, c.cause) << text(c.cause);
        EXPECT_EQ(out.output.given.force_device_N, Vec3(0.0)) << text(c.cause);
        seen.insert(out.output.cause);
    }
    std::set<std::string> texts;
    for (const GateCause cause : seen) texts.insert(text(cause));
    EXPECT_EQ(texts.size(), 12u);  // all but `none`, each with words of its own
    for (const std::string& words : texts) EXPECT_EQ(words.rfind("no force: ", 0), 0u) << words;
    EXPECT_EQ(texts.count(text(static_cast<GateCause>(200))), 0u);
}

TEST(SafetyGate, AStaleOrUnknownSurfaceDoesNotMatterInFreeSpace) {
    GateInput in = asking_for(Vec3(0.0));
    in.surface_stale = in.outside_known = true;
    EXPECT_EQ(pass_gate(open_at(Vec3(0.0)), in, {}, kDt).output.cause, GateCause::none);
}

TEST(SafetyGate, WaitsAfterAFaultAndThenFadesInAgain) {
    const GateLimits limits{.ramp_s = 0.1, .recovery_s = 0.05};
    GateInput in = asking_for({1.0, 0.0, 0.0});
    in.device_fault = devices::DeviceFault::disconnected;
    GateState state = pass_gate(open_at({1.0, 0.0, 0.0}), in, limits, kDt).next;
    in.device_fault = devices::DeviceFault::none;
    for (int i = 1; i <= 200; ++i) {
        const GateStep out = pass_gate(state, in, limits, kDt);
        if (i < 50) {
            EXPECT_EQ(out.output.given.force_device_N, Vec3(0.0)) << i;
        }
        if (i > 55 && i < 145) {
            EXPECT_NEAR(out.output.given.force_device_N.x, (i - 49) / 100.0, 0.011) << i;
        }
        if (i > 155) {
            EXPECT_EQ(out.output.given.force_device_N.x, 1.0) << i;
        }
        state = out.next;
    }
}

namespace {

GateInput turning_by(const Vec3& torque) {
    GateInput in = asking_for(Vec3(0.0));
    in.wanted.torque_device_Nm = torque;
    in.device_max_torque_Nm = {0.23, 0.0, 0.25};  // the wand: yaw is passive
    return in;
}

}  // namespace

TEST(SafetyGate, TorqueStaysWithinEachAxisOwnLimitAndPassiveAxesGetNone) {
    GateState open = open_at(Vec3(0.0));
    open.given.torque_device_Nm = {0.1, 0.0, -0.1};
    GateStep out = pass_gate(open, turning_by({0.1, 0.3, -0.1}), {}, kDt);
    EXPECT_EQ(out.output.given.torque_device_Nm, Vec3(0.1, 0.0, -0.1));  // within: the passive axis alone is left out
    EXPECT_FALSE(out.output.saturated);
    for (int i = 0; i < 100; ++i) {
        out = pass_gate(open, turning_by({-2.3, 5.0, 1.0}), {}, kDt);
        open = out.next;
    }
    EXPECT_TRUE(out.output.saturated);
    EXPECT_NEAR(out.output.given.torque_device_Nm.x, -0.23, 1e-12);
    EXPECT_LE(std::abs(out.output.given.torque_device_Nm.x), 0.23);
    EXPECT_EQ(out.output.given.torque_device_Nm.y, 0.0);
    EXPECT_NEAR(out.output.given.torque_device_Nm.z, 0.1, 1e-12);  // shortened, not turned
}

TEST(SafetyGate, TorqueChangesNoFasterThanItsSlewLimit) {
    const GateLimits limits{.max_torque_slew_Nm_per_s = 20.0};
    GateState state = open_at(Vec3(0.0));
    for (int i = 1; i <= 15; ++i) {
        const GateStep out = pass_gate(state, turning_by({0.21, 0.0, 0.0}), limits, kDt);
        EXPECT_NEAR(out.output.given.torque_device_Nm.x, std::min(0.21, 0.02 * i), 1e-9);
        EXPECT_EQ(out.output.slew_limited, i < 11) << i;
        state = out.next;
    }
}

TEST(SafetyGate, SlewHoldsNoTorqueAboveACapThatHasFallen) {
    const GateLimits limits{.max_torque_slew_Nm_per_s = 20.0};
    for (const Vec3& wanted : {Vec3(0.0), Vec3(0.1, 0.0, 0.1)}) {
        GateState open = open_at(Vec3(0.0));
        open.given.torque_device_Nm = {0.2, 0.0, 0.1};
        GateInput in = turning_by(wanted);
        in.most_torque_Nm = 0.05;
        const GateStep out = pass_gate(open, in, limits, kDt);
        EXPECT_LE(glm::length(out.output.given.torque_device_Nm), 0.05);
        EXPECT_GT(out.output.given.torque_device_Nm.x, 0.04) << "no lower than it must be";
    }
    GateInput in = turning_by(Vec3(0.0));
    in.most_torque_Nm = kNan;
    EXPECT_EQ(pass_gate(open_at(Vec3(0.0)), in, limits, kDt).output.cause, GateCause::not_finite);
}

TEST(SafetyGate, TheTickHandsItTheTorqueThatTheAccountAffords) {
    devices::DeviceDescription device;
    device.max_torque_Nm = Vec3(1.0);
    TickRecord record;
    EXPECT_EQ(gate_input(record, device).most_torque_Nm, HUGE_VAL);
    record.passivity.most_Nm = 0.02;
    record.contact.wrench.torque_device_Nm = {0.1, 0.0, 0.0};
    record.wanted.torque_device_Nm = {0.1, 0.0, 0.03};  // a held tool's weight turns it, too
    EXPECT_NEAR(gate_input(record, device).most_torque_Nm, 0.05, 1e-15);
}

TEST(SafetyGate, AnAxisWithALimitOfItsOwnIsNeverAskedForMore) {
    GateInput in = asking_for({0.0, 3.0, 0.5});
    in.device_axis_max_force_N = {2.3, 1.5, 0.0};  // z has none of its own
    const GateStep out = pass_gate(open_at({0.0, 1.5, 0.25}), in, {}, kDt);
    EXPECT_TRUE(out.output.saturated);
    EXPECT_NEAR(out.output.given.force_device_N.y, 1.5, 1e-12);
    EXPECT_LE(out.output.given.force_device_N.y, 1.5);
    EXPECT_NEAR(out.output.given.force_device_N.z, 0.25, 1e-12);
}

TEST(SafetyGate, AContactThatHasJumpedFadesIn) {
    const GateLimits limits{.contact_ramp_s = 0.1};
    GateInput in = asking_for({0.0, 1.0, 0.0});
    in.in_contact = true;
    in.contact_jumped = true;
    GateState state = open_at(Vec3(0.0));
    state.contact_ramp = 1.0;
    GateStep out = pass_gate(state, in, limits, kDt);
    EXPECT_EQ(out.output.given.force_device_N, Vec3(0.0));
    EXPECT_TRUE(out.output.ramping);
    in.contact_jumped = false;
    for (int i = 1; i <= 120; ++i) {
        out = pass_gate(out.next, in, limits, kDt);
        EXPECT_NEAR(out.output.given.force_device_N.y, std::min(1.0, i / 100.0), 1e-9) << i;
        EXPECT_EQ(out.output.ramping, i < 100) << i;
    }
    EXPECT_EQ(out.output.cause, GateCause::none);
}

TEST(SafetyGate, TorqueFadesInAsTheForceDoes) {
    GateState state;
    GateLimits limits;
    GateInput in;
    in.device_max_force_N = 3.0;
    in.device_max_torque_Nm = Vec3(1.0);
    in.wanted = {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.5}};
    limits.max_slew_N_per_s = limits.max_torque_slew_Nm_per_s = 1e9;
    for (int i = 0; i < 100; ++i) {
        const GateStep out = pass_gate(state, in, limits, 1e-3);
        ASSERT_NEAR(out.output.given.torque_device_Nm.z, 0.5 * out.output.given.force_device_N.x, 1e-12) << i;
        ASSERT_LE(out.output.given.force_device_N.x, 0.51) << "0.2 s to all of 1 N";
        state = out.next;
    }
}

}  // namespace burin::haptics
