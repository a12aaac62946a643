// SPDX-License-Identifier: MIT
// A tick with its gate, and the records of what it used and did.
#include <algorithm>

#include "haptics/tick.hpp"

namespace burin {
namespace {

void describe(TickRecord& record, const TickOutput& out) {
    const PointRecord& point = out.points[out.deepest];
    record.object_from_device = out.object_from_device;
    record.phase = out.workspace.phase;
    record.hip_object_m = point.hip_object_m;
    record.proxy_object_m = point.proxy_object_m;
    record.contact_normal_object = point.normal_object;
    record.penetration_m = point.penetration_m;
    record.active_triangle = point.active_triangle;
    record.constraints = point.constraints;
    record.point_count = out.point_count;
    std::copy_n(out.points.begin(), out.point_count, record.points.begin());
    record.cut_object_m = out.cut_object_m;
    record.velocity_device_m_per_s = out.velocity_device_m_per_s;
    record.wanted = out.wanted;
    record.stiffness_bound = out.stiffness_bound;
    record.passivity_energy_J = out.passivity_energy_J;
    record.passivity_damping_Ns_per_m = out.passivity_damping_Ns_per_m;
    record.work = out.work;
    record.flags = out.flags;
}

void describe(TickRecord& record, const GateOutput& gate) {
    record.given = gate.given;
    record.cause = gate.cause;
    if (gate.cause != GateCause::none) record.flags |= kTickFault;
    if (gate.saturated) record.flags |= kTickForceSaturated;
    if (gate.slew_limited) record.flags |= kTickSlewLimited;
    if (gate.ramping) record.flags |= kTickRamping;
}

StrokeSample stroke_of(const TickRecord& record, const TickOutput& out) {
    StrokeSample stroke;
    stroke.time_ns = record.time_ns;
    stroke.position_object_m = out.points[0].hip_object_m;
    stroke.cut_object_m = out.cut_object_m;
    stroke.proxy_object_m = out.points[0].proxy_object_m;
    stroke.orientation_object = out.orientation_object;
    stroke.force_object_N = out.object_from_device.orientation * record.given.force_device_N;
    stroke.buttons = record.sample.buttons;
    stroke.flags = record.flags;
    stroke.surface_sequence = record.surface_sequence;
    stroke.parameter_sequence = record.parameter_sequence;
    stroke.phase = record.phase;
    return stroke;
}

}  // namespace

FullTick full_tick(const FullTickState& state, const DeviceSample& sample, const LocalSurface& surface,
                   const TickParameters& parameters, const DeviceDescription& device, Nanoseconds now_ns,
                   double dt_s) noexcept {
    FullTick full;
    const TickOutput out = tick(state.tick, sample, surface, parameters, device, now_ns, dt_s);
    GateInput input = gate_input(out, sample, device, now_ns);
    if (state.now_ns > 0) input.loop_gap_s = seconds(now_ns - state.now_ns);
    const GateOutput gate = pass_gate(state.gate, input, parameters.limits, dt_s);
    full.next.tick = out.next;
    full.next.gate = gate.next;
    full.next.now_ns = now_ns;
    // The controller's account is of contact alone: what else was given is not its business.
    const Vec3 others_N = out.wanted.force_device_N - out.contact.force_device_N;
    const bool on = gate.cause == GateCause::none;
    full.next.tick.passivity = told(out.next.passivity, on ? gate.given.force_device_N - others_N : Vec3(0.0));

    TickRecord& record = full.record;
    record.time_ns = now_ns;
    record.sample = sample;
    record.surface_sequence = surface.sequence;
    record.parameter_sequence = parameters.sequence;
    describe(record, out);
    describe(record, gate);
    if (input.loop_gap_s > 1.5 * dt_s) record.flags |= kTickLoopGap;
    full.stroke = stroke_of(record, out);
    full.workspace = out.workspace;
    return full;
}

}  // namespace burin
