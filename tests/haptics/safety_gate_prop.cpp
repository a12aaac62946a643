// SPDX-License-Identifier: MIT
// Whatever comes in, what goes out is finite, within the limit and no faster than the slew limit.
#include "haptics/stability/safety_gate.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <vector>

namespace burin::haptics {
namespace {

// Ordinary numbers mostly, nasty ones often.
double any_number() {
    const int kind = *rc::gen::inRange(0, 12);
    const double ordinary = *rc::gen::inRange(-5000, 5000) / 1000.0;
    switch (kind) {
        case 0: return std::numeric_limits<double>::quiet_NaN();
        case 1: return std::numeric_limits<double>::infinity();
        case 2: return -std::numeric_limits<double>::max();
        case 3: return std::numeric_limits<double>::denorm_min();
        case 4: return ordinary * 1e150;
        default: return ordinary;
    }
}

Vec3 any_vector() {
    const double x = any_number(), y = any_number(), z = any_number();
    return {x, y, z};
}

GateInput any_input() {
    GateInput in;
    in.wanted.force_device_N = any_vector();
    if (*rc::gen::inRange(0, 3) == 0) in.wanted.torque_device_Nm = any_vector();
    in.device_max_torque_Nm = {0.23, 0.0, 0.25};
    if (*rc::gen::inRange(0, 10) == 0) in.device_max_torque_Nm = any_vector();
    if (*rc::gen::inRange(0, 10) == 0) in.device_axis_max_force_N = any_vector();
    in.loop_gap_s = *rc::gen::inRange(0, 10) == 0 ? any_number() : 0.001;
    in.sample_finite = *rc::gen::inRange(0, 20) != 0;
    in.parameters_sensible = *rc::gen::inRange(0, 20) != 0;
    in.contact_jumped = *rc::gen::inRange(0, 20) == 0;
    in.outside_known = *rc::gen::inRange(0, 20) == 0;
    if (*rc::gen::inRange(0, 4) == 0) in.velocity_device_m_per_s = any_vector();
    in.device_max_force_N = *rc::gen::inRange(0, 8) == 0 ? any_number() : 3.3;
    in.sample_age_s = *rc::gen::inRange(0, 8) == 0 ? any_number() : 0.0;
    in.device_fault = *rc::gen::inRange(0, 20) == 0 ? devices::DeviceFault::other : devices::DeviceFault::none;
    in.in_contact = *rc::gen::arbitrary<bool>();
    in.surface_stale = *rc::gen::inRange(0, 10) == 0;
    return in;
}

}  // namespace

TEST(SafetyGate, NeverExceedsForceOrSlewLimitOnAnyInput) {
    EXPECT_TRUE(rc::check([] {
        GateLimits limits;
        limits.max_force_N = *rc::gen::inRange(0, 6000) / 1000.0;
        limits.max_slew_N_per_s = *rc::gen::inRange(0, 3000);
        limits.ramp_s = *rc::gen::inRange(0, 20) / 1000.0;
        limits.recovery_s = *rc::gen::inRange(0, 5) / 1000.0;
        GateState state;
        for (int i = 0; i < 60; ++i) {
            const GateInput in = any_input();
            const GateStep out = pass_gate(state, in, limits, 1e-3);
            const double force = glm::length(out.output.given.force_device_N);
            RC_ASSERT(std::isfinite(force));
            RC_ASSERT(force <= limits.max_force_N);
            if (out.output.cause != GateCause::none) {
                RC_ASSERT(out.output.given.force_device_N == Vec3(0.0));
            } else {
                RC_ASSERT(force <= in.device_max_force_N);
                const double change = glm::length(out.output.given.force_device_N - state.given.force_device_N);
                // Rounding of the difference of two forces up to 6 N; and the force limit may win when it falls.
                const Vec3& before = state.given.force_device_N;
                bool device_limit_fell = in.device_max_force_N < glm::length(before);
                for (int axis = 0; axis < 3; ++axis) {
                    const double most = in.device_axis_max_force_N[axis];
                    device_limit_fell = device_limit_fell || (most > 0.0 && std::abs(before[axis]) > most);
                }
                RC_ASSERT(device_limit_fell || change <= limits.max_slew_N_per_s * 1e-3 + 1e-14);
            }
            state = out.next;
        }
    }));
}

TEST(SafetyGate, NeverExceedsAnAxisLimitOfForceOrTorqueOnAnyInputOrLimits) {
    EXPECT_TRUE(rc::check([] {
        GateLimits limits;
        if (*rc::gen::inRange(0, 3) == 0) {
            limits = {any_number(), any_number(), any_number(), any_number(), any_number(),
                      any_number(), any_number(), any_number(), any_number()};
        }
        GateState state;
        for (int i = 0; i < 40; ++i) {
            const GateInput in = any_input();
            const GateStep out = pass_gate(state, in, limits, 1e-3);
            const Vec3 &force = out.output.given.force_device_N, &torque = out.output.given.torque_device_Nm;
            RC_ASSERT(std::isfinite(glm::length(force)) && std::isfinite(glm::length(torque)));
            for (int axis = 0; axis < 3; ++axis) {
                const double most_N = in.device_axis_max_force_N[axis], most_Nm = in.device_max_torque_Nm[axis];
                if (out.output.cause == GateCause::none) {
                    RC_ASSERT(most_N == 0.0 || std::abs(force[axis]) <= most_N);
                    RC_ASSERT(std::abs(torque[axis]) <= most_Nm);  // a passive axis has 0
                } else {
                    RC_ASSERT(force[axis] == 0.0 && torque[axis] == 0.0);
                }
            }
            RC_ASSERT(out.next.ramp >= 0.0 && out.next.ramp <= 1.0);
            RC_ASSERT(out.next.contact_ramp >= 0.0 && out.next.contact_ramp <= 1.0);
            state = out.next;
        }
    }));
}

TEST(SafetyGate, TorqueStaysBelowItsCapHoweverThatFalls) {
    EXPECT_TRUE(rc::check([] {
        const auto thousandths = [](int most) { return *rc::gen::inRange(0, most) / 1000.0; };
        const GateLimits limits{.max_torque_slew_Nm_per_s = 1.0 * *rc::gen::inRange(0, 100), .ramp_s = 0.0};
        GateState state;
        for (int i = 0; i < 40; ++i) {
            GateInput in;
            in.wanted.torque_device_Nm = {thousandths(400) - 0.2, thousandths(400) - 0.2, thousandths(400) - 0.2};
            in.device_max_torque_Nm = {0.23, 0.23, 0.25};
            in.most_torque_Nm = thousandths(300);
            const GateStep out = pass_gate(state, in, limits, 1e-3);
            RC_ASSERT(glm::length(out.output.given.torque_device_Nm) <= in.most_torque_Nm);
            state = out.next;
        }
    }));
}

}  // namespace burin::haptics
