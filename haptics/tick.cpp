// SPDX-License-Identifier: MIT
#include "haptics/tick.hpp"

#include <algorithm>
#include <cmath>

#include "base/sensible.hpp"
#include "haptics/probe_contact.hpp"

namespace burin {
namespace {

bool unit(const Quat& q) {
    // A comparison that a NaN fails.
    return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-6;
}

// The encoders of a wrist are coarser than those of an arm; this is one step of a common one, 4096 a turn.
constexpr double kTurnNoise_rad = 0.0016;

// The rotation from one orientation to the next as axis times angle; small.
Vec3 turn_between(const Quat& from, const Quat& to) {
    Quat q = to * glm::conjugate(from);
    if (q.w < 0.0) q = -q;
    return {2.0 * q.x, 2.0 * q.y, 2.0 * q.z};
}

// New samples only; after a gap the old ones would make the motion look faster than it was.
void take_sample(TickState& state, const DeviceSample& sample, bool turns, double dt_s) {
    const double gap_s = seconds(sample.time_ns - state.sample_ns);
    if (state.window.count > 0 && gap_s <= 0.0) return;
    if (gap_s > 1.5 * dt_s) state.window.count = state.turning.count = 0;
    state.window = with_position(state.window, sample.position_device_m);
    state.sample_ns = sample.time_ns;
    if (turns) {
        const VelocityWindow& w = state.turning;
        const Vec3 turned =
            w.count == 0 ? Vec3(0.0)
                         : w.positions_m[w.newest] + turn_between(state.orientation_device, sample.orientation_device);
        state.turning = with_position(w, turned);
    }
    state.orientation_device = sample.orientation_device;
}

void estimate_motion(TickOutput& out, const TickParameters& parameters, double dt_s) {
    const VelocityEstimate estimate = estimate_velocity(parameters.signals, out.next.window, out.next.velocity_average,
                                                        parameters.position_noise_m, dt_s);
    out.velocity_device_m_per_s = estimate.velocity_m_per_s;
    out.next.velocity_average = estimate.average;
    if (out.point_count > 1) {
        out.angular_velocity_device_rad_per_s = velocity_m_per_s(out.next.turning, kTurnNoise_rad, dt_s);
    }
}

void forget_contact(TickState& state) {
    for (ProxyState& proxy : state.proxies) proxy.placed = false;
    state.cutting.engaged = false;
}

// Where the device is in the scene, by the workspace's technique. What a jump has made meaningless is forgotten.
WorkspaceStep map_workspace(TickOutput& out, const DeviceSample& sample, const TickParameters& parameters,
                            double dt_s) {
    const WorkspaceInput input{sample.position_device_m, out.velocity_device_m_per_s, sample.buttons,
                               out.next.in_contact, dt_s};
    const WorkspaceStep step = step_workspace(out.next.workspace, parameters.workspace, input);
    out.next.workspace = step.next;
    out.object_from_device = step.object_from_device;
    out.orientation_object = step.object_from_device.orientation * sample.orientation_device;
    out.workspace = step.picture;
    if (step.paused) out.flags |= kTickPaused;
    if (step.jumped || step.paused || !parameters.enabled) forget_contact(out.next);
    if (!out.next.proxies[0].placed) out.flags |= kTickProxyReset;
    return step;
}

// The force filter of choice, and the controller that takes back what the sampled wall gives out too much.
void condition_contact(TickOutput& out, const DeviceSample& sample, const TickParameters& parameters,
                       const DeviceDescription& device, double dt_s) {
    const double alpha = parameters.signals.force_alpha;
    out.next.force_average = with_input(out.next.force_average, out.contact.force_device_N, alpha);
    if (alpha > 0.0) out.contact.force_device_N = out.next.force_average.value;
    PassivityInput input;
    input.position_device_m = sample.position_device_m;
    input.wanted_force_device_N = out.contact.force_device_N;
    input.stored_J = out.spring_energy_J;
    input.max_force_N = std::min(parameters.limits.max_force_N, device.max_force_N);
    input.in_contact = (out.flags & kTickInContact) != 0;
    input.jumped = out.contact_jumped;
    const PassivityStep kept = keep_passive(out.next.passivity, input, parameters.passivity, device, dt_s);
    out.next.passivity = kept.next;
    out.contact.force_device_N = kept.force_device_N;
    out.passivity_energy_J = kept.energy_J;
    out.passivity_damping_Ns_per_m = kept.damping_Ns_per_m;
    if (kept.damping_Ns_per_m > 0.0) out.flags |= kTickPassivityActs;
}

// What acts in free space too: the tool's weight, the curve that draws it, the workspace's elastic border.
DeviceWrench other_forces(TickOutput& out, const DeviceSample& sample, const TickParameters& parameters,
                          const Vec3& workspace_force_device_N, double dt_s) {
    DeviceWrench sum = weight_wrench(parameters.weight, sample.orientation_device);
    const GuidanceStep guided = guide(out.next.guidance,
                                      {out.points[0].hip_object_m, out.velocity_device_m_per_s,
                                       out.object_from_device.orientation, out.object_from_device.scale, dt_s},
                                      parameters.curve, parameters.guidance);
    out.next.guidance = guided.next;
    if (guided.next.held) out.flags |= kTickGuided;
    sum.force_device_N += guided.force_device_N + workspace_force_device_N;
    return sum;
}

}  // namespace

TickOutput tick(const TickState& state, const DeviceSample& sample, const LocalSurface& surface,
                const TickParameters& parameters, const DeviceDescription& device, Nanoseconds now_ns,
                double dt_s) noexcept {
    TickOutput out;
    out.next = state;
    out.sample_finite = finite(sample.position_device_m) && unit(sample.orientation_device);
    out.parameters_sensible = parameters_are_sensible(parameters);
    if (!out.sample_finite || !out.parameters_sensible) {
        forget_contact(out.next);  // start afresh when all is well again
        out.next.window.count = out.next.turning.count = 0;
        out.next.passivity.known = false;
        out.point_count = 1;
        // where the tool was last known to be
        out.points[0].hip_object_m = out.points[0].proxy_object_m = state.proxies[0].position_object_m;
        out.object_from_device = state.workspace.object_from_device;
        return out;
    }
    out.point_count = parameters.probe.count;
    take_sample(out.next, sample, out.point_count > 1, dt_s);
    estimate_motion(out, parameters, dt_s);
    const WorkspaceStep workspace = map_workspace(out, sample, parameters, dt_s);

    const bool searchable = surface.sequence > 0;
    if (!searchable) out.flags |= kTickNoSurface;
    if (searchable && parameters.enabled && !workspace.paused) {
        out.contact = touch_surface(out, sample, surface, parameters, device, dt_s);
    } else {
        follow_hand(out, sample, surface, parameters);
    }
    out.next.in_contact = (out.flags & kTickInContact) != 0;
    const double age_s = seconds(now_ns - surface.made_ns);
    if (out.next.in_contact && parameters.max_surface_age_s > 0.0 && age_s > parameters.max_surface_age_s)
        out.flags |= kTickStaleSurface;
    condition_contact(out, sample, parameters, device, dt_s);
    const DeviceWrench others = other_forces(out, sample, parameters, workspace.force_device_N, dt_s);
    out.wanted = driven_part(
        {out.contact.force_device_N + others.force_device_N, out.contact.torque_device_Nm + others.torque_device_Nm},
        device);
    return out;
}

GateInput gate_input(const TickOutput& out, const DeviceSample& sample, const DeviceDescription& device,
                     Nanoseconds now_ns) noexcept {
    GateInput in;
    in.wanted = out.wanted;
    in.velocity_device_m_per_s = out.velocity_device_m_per_s;
    in.device_max_force_N = device.max_force_N;
    in.device_axis_max_force_N = device.axis_max_force_N;
    in.device_max_torque_Nm = device.max_torque_Nm;
    in.sample_age_s = seconds(now_ns - sample.time_ns);
    in.device_fault = sample.fault;
    in.sample_finite = out.sample_finite;
    in.parameters_sensible = out.parameters_sensible;
    in.in_contact = (out.flags & kTickInContact) != 0;
    in.contact_jumped = out.contact_jumped;
    in.surface_stale = (out.flags & kTickStaleSurface) != 0;
    in.outside_known = (out.flags & kTickOutsideKnown) != 0;
    return in;
}

}  // namespace burin
