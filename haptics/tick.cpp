// SPDX-License-Identifier: MIT
#include "haptics/tick.hpp"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool unit(const Quat& q) {
    // A comparison that a NaN fails.
    return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-6;
}

bool not_negative(double x) { return std::isfinite(x) && x >= 0.0; }

bool same(const Similarity& a, const Similarity& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.scale == b.scale;
}

// New samples only; after a gap the old ones would make the motion look faster than it was.
void take_sample(TickState& state, const DeviceSample& sample, double dt_s) {
    const double gap_s = seconds(sample.time_ns - state.sample_ns);
    if (state.window.count > 0 && gap_s <= 0.0) return;
    if (gap_s > 1.5 * dt_s) state.window.count = 0;
    state.window = with_position(state.window, sample.position_device_m);
    state.sample_ns = sample.time_ns;
}

// Back to where the hand is: nothing is remembered of a contact that the new mapping or a pause has made meaningless.
void follow_mapping(TickOutput& out, const TickParameters& parameters) {
    TickState& state = out.next;
    if (!state.mapping_known || !same(state.object_from_device, parameters.object_from_device)) {
        state.object_from_device = parameters.object_from_device;
        state.mapping_known = true;
        state.proxy.placed = false;
    }
    if (!parameters.enabled) state.proxy.placed = false;
    if (!state.proxy.placed) out.flags |= kTickProxyReset;
}

void make_contact(TickOutput& out, const LocalSurface& surface, const TickParameters& parameters) {
    const double contact_radius = parameters.tool_radius_m * (1.0 - parameters.clearance_ratio);
    const ProxyResult moved = move_proxy(out.next.proxy, out.hip_object_m, contact_radius, surface);
    out.next.proxy = moved.next;
    out.work = {moved.work.triangles_tested, moved.work.triangles_seen, moved.work.steps, moved.work.plane_solves};
    if (moved.pushed_out) out.flags |= kTickPushedOut;
    if (moved.work_limited) out.flags |= kTickWorkLimited;
    const Vec3 reach = moved.next.position_object_m - surface.center_object;
    if (!(std::sqrt(glm::dot(reach, reach)) + contact_radius <= surface.radius_m)) out.flags |= kTickOutsideKnown;
    const Vec3 spring = moved.next.position_object_m - out.hip_object_m;
    const double depth = std::sqrt(glm::dot(spring, spring));
    if (moved.constraints == 0 || !(depth > 0.0)) return;
    out.flags |= kTickInContact;
    out.constraints = moved.constraints;
    out.active_triangle = moved.active_triangle;
    out.penetration_m = depth;
    out.contact_normal_object = spring / depth;
}

// F = k dx + b dx/dt along the contact normal, at the device: dx shrinks by the gain on its way there, and so k and b
// are felt as set.
Vec3 contact_force_device(const TickOutput& out, const TickParameters& parameters) {
    const Similarity& map = parameters.object_from_device;
    const Vec3 normal_device = glm::conjugate(map.orientation) * out.contact_normal_object;
    const double spring_N = parameters.stiffness_N_per_m * (out.penetration_m / map.scale);
    const double damping_N = -parameters.damping_Ns_per_m * glm::dot(out.velocity_device_m_per_s, normal_device);
    return normal_device * std::max(0.0, spring_N + damping_N);  // never into the surface
}

}  // namespace

bool parameters_are_sensible(const TickParameters& p) noexcept {
    const Similarity& map = p.object_from_device;
    return finite(map.position_m) && unit(map.orientation) && std::isfinite(map.scale) && map.scale > 0.0 &&
           not_negative(p.tool_radius_m) && not_negative(p.clearance_ratio) && p.clearance_ratio < 1.0 &&
           not_negative(p.stiffness_N_per_m) && not_negative(p.damping_Ns_per_m) && not_negative(p.position_noise_m) &&
           not_negative(p.max_surface_age_s);
}

TickOutput tick(const TickState& state, const DeviceSample& sample, const LocalSurface& surface,
                const TickParameters& parameters, Nanoseconds now_ns, double dt_s) noexcept {
    TickOutput out;
    out.next = state;
    out.sample_finite = finite(sample.position_device_m) && unit(sample.orientation_device);
    out.parameters_sensible = parameters_are_sensible(parameters);
    if (!out.sample_finite || !out.parameters_sensible) {
        out.next.proxy.placed = false;  // start afresh when all is well again
        out.next.window.count = 0;
        out.hip_object_m = state.proxy.position_object_m;  // where the tool was last known to be
        return out;
    }
    take_sample(out.next, sample, dt_s);
    out.velocity_device_m_per_s = velocity_m_per_s(out.next.window, parameters.position_noise_m, dt_s);
    out.hip_object_m = parameters.object_from_device * sample.position_device_m;
    out.orientation_object = parameters.object_from_device.orientation * sample.orientation_device;
    follow_mapping(out, parameters);
    const bool searchable = surface.sequence > 0;
    if (!searchable) out.flags |= kTickNoSurface;
    if (!searchable || !parameters.enabled) {
        out.next.proxy = {out.hip_object_m, surface.sequence, false};
        return out;
    }
    make_contact(out, surface, parameters);
    if ((out.flags & kTickInContact) == 0) return out;
    const double age_s = seconds(now_ns - surface.made_ns);
    if (parameters.max_surface_age_s > 0.0 && age_s > parameters.max_surface_age_s) out.flags |= kTickStaleSurface;
    out.force_device_N = contact_force_device(out, parameters);
    return out;
}

GateInput gate_input(const TickOutput& out, const DeviceSample& sample, const DeviceDescription& device,
                     Nanoseconds now_ns) noexcept {
    GateInput in;
    in.wanted_force_device_N = out.force_device_N;
    in.velocity_device_m_per_s = out.velocity_device_m_per_s;
    in.device_max_force_N = device.max_force_N;
    in.sample_age_s = seconds(now_ns - sample.time_ns);
    in.device_fault = sample.fault;
    in.sample_finite = out.sample_finite;
    in.parameters_sensible = out.parameters_sensible;
    in.in_contact = (out.flags & kTickInContact) != 0;
    in.surface_stale = (out.flags & kTickStaleSurface) != 0;
    in.outside_known = (out.flags & kTickOutsideKnown) != 0;
    return in;
}

FullTick full_tick(const FullTickState& state, const DeviceSample& sample, const LocalSurface& surface,
                   const TickParameters& parameters, const DeviceDescription& device, Nanoseconds now_ns,
                   double dt_s) noexcept {
    FullTick full;
    const TickOutput out = tick(state.tick, sample, surface, parameters, now_ns, dt_s);
    const GateOutput gate = pass_gate(state.gate, gate_input(out, sample, device, now_ns), parameters.limits, dt_s);
    full.next = {out.next, gate.next};

    TickRecord& record = full.record;
    record.time_ns = now_ns;
    record.sample = sample;
    record.surface_sequence = surface.sequence;
    record.parameter_sequence = parameters.sequence;
    record.hip_object_m = out.hip_object_m;
    record.proxy_object_m = out.next.proxy.position_object_m;
    record.velocity_device_m_per_s = out.velocity_device_m_per_s;
    record.contact_normal_object = out.contact_normal_object;
    record.penetration_m = out.penetration_m;
    record.active_triangle = out.active_triangle;
    record.constraints = out.constraints;
    record.wanted_force_device_N = out.force_device_N;
    record.force_device_N = gate.force_device_N;
    record.cause = gate.cause;
    record.work = out.work;
    record.flags = out.flags;
    if (gate.cause != GateCause::none) record.flags |= kTickFault;
    if (gate.saturated) record.flags |= kTickForceSaturated;
    if (gate.slew_limited) record.flags |= kTickSlewLimited;
    if (gate.ramping) record.flags |= kTickRamping;

    StrokeSample& stroke = full.stroke;
    stroke.time_ns = now_ns;
    stroke.position_object_m = record.hip_object_m;
    stroke.proxy_object_m = record.proxy_object_m;
    stroke.orientation_object = out.orientation_object;
    if (out.parameters_sensible)
        stroke.force_object_N = parameters.object_from_device.orientation * gate.force_device_N;
    stroke.buttons = sample.buttons;
    stroke.flags = record.flags;
    stroke.surface_sequence = surface.sequence;
    stroke.parameter_sequence = parameters.sequence;
    return full;
}

}  // namespace burin
