// SPDX-License-Identifier: MIT
#include "haptics/stability/safety_gate.hpp"

#include <algorithm>
#include <cmath>

#include "base/space.hpp"

namespace burin::haptics {
namespace {

bool sensible(const GateLimits& limits) {
    return not_negative(limits.max_force_N) && not_negative(limits.max_slew_N_per_s) && not_negative(limits.ramp_s) &&
           not_negative(limits.recovery_s) && not_negative(limits.max_speed_m_per_s) &&
           not_negative(limits.max_torque_slew_Nm_per_s) && not_negative(limits.contact_ramp_s) &&
           not_negative(limits.max_loop_gap_s) && not_negative(limits.max_sample_age_s) &&
           not_negative(limits.max_ahead_s);
}

// Without a promise one lost tick, and half a period of jitter, go unnoticed.
constexpr double kUnnoticed = 2.5, kLeastGap = 4.5;  // periods

double longest_gap_s(const GateInput& in, const GateLimits& limits, double dt_s) {
    return std::max({limits.max_loop_gap_s, kLeastGap * dt_s, in.promised_gap_s});
}

// The share of the force that is left after a gap.
double left_after(const GateInput& in, const GateLimits& limits, double dt_s) {
    if (in.loop_gap_s <= std::max(kUnnoticed * dt_s, in.promised_gap_s)) return 1.0;
    const double longest_s = longest_gap_s(in, limits, dt_s), unnoticed_s = kUnnoticed * dt_s;
    return std::clamp((longest_s - in.loop_gap_s) / (longest_s - unnoticed_s), 0.0, 1.0);
}

GateCause find_cause(const GateState& state, const GateInput& in, const GateLimits& limits, double dt_s) {
    if (in.device_fault != devices::DeviceFault::none) return GateCause::device_fault;
    if (!in.sample_finite || !std::isfinite(glm::length(in.wanted.force_device_N)) ||
        !std::isfinite(glm::length(in.wanted.torque_device_Nm)) || !finite(in.velocity_device_m_per_s) ||
        !std::isfinite(in.sample_age_s) || !std::isfinite(in.loop_gap_s) || !not_negative(in.promised_gap_s) ||
        !not_negative(in.device_max_force_N) || !not_negative(in.device_axis_max_force_N) ||
        !not_negative(in.device_max_torque_Nm) || !(in.most_torque_Nm >= 0.0))
        return GateCause::not_finite;
    if (!in.parameters_sensible || !sensible(limits)) return GateCause::bad_parameters;
    if (!in.scale_felt) return GateCause::bad_scale;
    if (in.sample_age_s > limits.max_sample_age_s) return GateCause::stale_sample;
    if (in.sample_age_s < -limits.max_ahead_s) return GateCause::future_sample;
    if (!in.within_reach) return GateCause::out_of_reach;
    const bool held = state.given.force_device_N != Vec3(0.0) || state.given.torque_device_Nm != Vec3(0.0);
    if (held && in.loop_gap_s > longest_gap_s(in, limits, dt_s)) return GateCause::lost_loop;
    if (glm::length(in.velocity_device_m_per_s) > limits.max_speed_m_per_s) return GateCause::overspeed;
    if (in.in_contact && in.surface_stale) return GateCause::stale_surface;
    if (in.in_contact && in.outside_known) return GateCause::outside_known;
    if (in.let_go) return GateCause::caught;
    return GateCause::none;
}

// Scales a vector to at most the length `most`, less a rounding margin.
Vec3 shortened(const Vec3& v, double most, bool& cut) {
    const double l = glm::length(v);
    if (l <= most) return v;
    cut = true;
    return v * (most * (1.0 - 1e-15) / l);
}

// Likewise for limits of single axes. A limit of 0 means no limit, or a passive axis.
Vec3 within_axes(Vec3 v, const Vec3& most, bool zero_is_none, bool& cut) {
    double share = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (most[axis] == 0.0 && !zero_is_none) v[axis] = 0.0;
        if (most[axis] > 0.0 && std::abs(v[axis]) * share > most[axis]) share = most[axis] / std::abs(v[axis]);
    }
    if (share == 1.0) return v;
    cut = true;
    return v * (share * (1.0 - 1e-15));
}

double risen(double ramp, double ramp_s, double dt_s) {
    return ramp_s > dt_s ? std::min(1.0, ramp + dt_s / ramp_s) : 1.0;
}

struct Limited {
    double most = 0.0;
    Vec3 axis_most{0.0};
    bool zero_is_none = true;
    double most_change = 0.0;
};

Vec3 passed(const Vec3& before, const Vec3& wanted, const Limited& limit, GateOutput& out) {
    const auto inside = [&](const Vec3& v) {
        return within_axes(shortened(v, limit.most, out.saturated), limit.axis_most, limit.zero_is_none, out.saturated);
    };
    const Vec3 target = inside(wanted);
    bool slewed = false;
    const Vec3 step = shortened(target - before, limit.most_change, slewed);
    out.slew_limited = out.slew_limited || slewed;
    // The result lies between two values within the limits, and exceeds them only when a limit has just been lowered.
    return inside(slewed ? before + step : target);
}

}  // namespace

const char* text(GateCause cause) noexcept {
    switch (cause) {
        case GateCause::none: return "force is on";
        case GateCause::device_fault: return "no force: the device reports a fault";
        case GateCause::not_finite: return "no force: a position or force is not a number";
        case GateCause::bad_parameters: return "no force: the haptic settings make no sense";
        case GateCause::bad_scale: return "no force: the scale of the scene is not between 1e-6 and 1e6";
        case GateCause::stale_sample: return "no force: the device has stopped sending";
        case GateCause::future_sample: return "no force: the device's time stamps lie ahead of the clock";
        case GateCause::out_of_reach: return "no force: the device reports a position out of its reach";
        case GateCause::overspeed: return "no force: the tool moves too fast";
        case GateCause::stale_surface: return "no force: the surface touched is out of date";
        case GateCause::outside_known: return "no force: the surface is not known here";
        case GateCause::caught: return "no force: the tool was caught on the surface and has been let go";
        case GateCause::lost_loop: return "no force: the haptic loop stood still";
    }
    return "no force: unknown cause";
}

GateStep pass_gate(const GateState& state, const GateInput& input, const GateLimits& limits, double dt_s) noexcept {
    GateStep step;
    GateState& next = step.next;
    GateOutput& out = step.output;
    out.cause = find_cause(state, input, limits, dt_s);
    if (out.cause != GateCause::none) {
        next.faulted = true;
        return step;
    }
    next.well_s = std::min(state.well_s + dt_s, 1e6);  // only compared with much smaller values
    next.faulted = state.faulted && next.well_s < limits.recovery_s;
    if (!next.faulted) next.ramp = risen(state.ramp, limits.ramp_s, dt_s);
    // Only a contact can jump; out of contact the ramp is kept for the next one.
    next.contact_ramp = input.contact_jumped ? 0.0 : risen(state.contact_ramp, limits.contact_ramp_s, dt_s);
    next.contact_ramp = std::min(next.contact_ramp, left_after(input, limits, dt_s));
    out.ramping = next.ramp < 1.0 || next.contact_ramp < 1.0;
    const double ramp = next.faded();
    const Limited force{std::min(limits.max_force_N, input.device_max_force_N), input.device_axis_max_force_N, true,
                        limits.max_slew_N_per_s * dt_s};
    const Limited torque{input.most_torque_Nm, input.device_max_torque_Nm, false,
                         limits.max_torque_slew_Nm_per_s * dt_s};
    const Vec3 before_N = input.drives_device == Vec3(0.0)
                              ? state.given.force_device_N
                              : glm::length(state.given.force_device_N) * input.drives_device;
    out.given.force_device_N = passed(before_N, ramp * input.wanted.force_device_N, force, out);
    out.given.torque_device_Nm =
        passed(state.given.torque_device_Nm, ramp * input.wanted.torque_device_Nm, torque, out);
    next.given = out.given;
    return step;
}

}  // namespace burin::haptics
