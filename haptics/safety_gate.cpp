// SPDX-License-Identifier: MIT
#include "haptics/safety_gate.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

bool not_negative(double x) { return std::isfinite(x) && x >= 0.0; }

bool sensible(const GateLimits& limits) {
    return not_negative(limits.max_force_N) && not_negative(limits.max_slew_N_per_s) && not_negative(limits.ramp_s) &&
           not_negative(limits.recovery_s) && not_negative(limits.max_speed_m_per_s) &&
           not_negative(limits.max_sample_age_s);
}

GateCause find_cause(const GateInput& in, const GateLimits& limits) {
    if (in.device_fault != DeviceFault::none) return GateCause::device_fault;
    if (!in.sample_finite || !std::isfinite(length(in.wanted_force_device_N)) || !finite(in.velocity_device_m_per_s) ||
        !std::isfinite(in.sample_age_s) || !not_negative(in.device_max_force_N))
        return GateCause::not_finite;
    if (!in.parameters_sensible || !sensible(limits)) return GateCause::bad_parameters;
    if (in.sample_age_s > limits.max_sample_age_s) return GateCause::stale_sample;
    if (length(in.velocity_device_m_per_s) > limits.max_speed_m_per_s) return GateCause::overspeed;
    if (in.in_contact && in.surface_stale) return GateCause::stale_surface;
    if (in.in_contact && in.outside_known) return GateCause::outside_known;
    return GateCause::none;
}

// Shortened to at most `most`; a hair less, so that rounding cannot leave it a hair more.
Vec3 shortened(const Vec3& v, double most, bool& cut) {
    const double l = length(v);
    if (l <= most) return v;
    cut = true;
    return v * (most * (1.0 - 1e-15) / l);
}

}  // namespace

const char* text(GateCause cause) noexcept {
    switch (cause) {
        case GateCause::none: return "force is on";
        case GateCause::device_fault: return "no force: the device reports a fault";
        case GateCause::not_finite: return "no force: a position or force is not a number";
        case GateCause::bad_parameters: return "no force: the haptic settings make no sense";
        case GateCause::stale_sample: return "no force: the device has stopped sending";
        case GateCause::overspeed: return "no force: the tool moves too fast";
        case GateCause::stale_surface: return "no force: the surface touched is out of date";
        case GateCause::outside_known: return "no force: the surface is not known here";
    }
    return "no force: unknown cause";
}

GateOutput pass_gate(const GateState& state, const GateInput& input, const GateLimits& limits, double dt_s) noexcept {
    GateOutput out;
    out.cause = find_cause(input, limits);
    if (out.cause != GateCause::none) {
        out.next.faulted = true;
        return out;
    }
    out.next.well_s = std::min(state.well_s + dt_s, 1e6);  // what is compared is far below
    out.next.faulted = state.faulted && out.next.well_s < limits.recovery_s;
    if (!out.next.faulted)
        out.next.ramp = limits.ramp_s > dt_s ? std::min(1.0, state.ramp + dt_s / limits.ramp_s) : 1.0;
    out.ramping = out.next.ramp < 1.0;
    const double most_N = std::min(limits.max_force_N, input.device_max_force_N);
    const Vec3 target = shortened(out.next.ramp * input.wanted_force_device_N, most_N, out.saturated);
    const Vec3 step = shortened(target - state.force_device_N, limits.max_slew_N_per_s * dt_s, out.slew_limited);
    // Between two forces within the limit; beyond it only when the limit has just been lowered.
    out.force_device_N = out.slew_limited ? state.force_device_N + step : target;
    out.force_device_N = shortened(out.force_device_N, most_N, out.saturated);
    out.next.force_device_N = out.force_device_N;
    return out;
}

}  // namespace burin
