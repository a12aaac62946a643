// SPDX-License-Identifier: MIT
#include "haptics/tick.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/space.hpp"

namespace burin::haptics {
namespace {

bool unit(const Quat& q) {
    // NaN fails this comparison.
    return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-6;
}

// Noise bound of the orientation: one step of a common wrist encoder, 4096 a turn; a wrist's are coarser than an arm's.
constexpr double kTurnNoise_rad = 0.0016;

// Rotation vector from one orientation to the next, for small angles.
Vec3 turn_between(const Quat& from, const Quat& to) {
    Quat q = to * glm::conjugate(from);
    if (q.w < 0.0) q = -q;
    return {2.0 * q.x, 2.0 * q.y, 2.0 * q.z};
}

// Adds new samples only; clears the windows after a gap, since older samples would overestimate the speed.
MotionState with_sample(MotionState state, const devices::DeviceSample& sample, bool turns, double dt_s) {
    const double gap_s = seconds(sample.time_ns - state.sample_ns);
    if (state.window.count > 0 && gap_s == 0.0) return state;
    // Also after a clock that was set back.
    if (gap_s > 1.5 * dt_s || gap_s < 0.0) state.window.count = state.turning.count = 0;
    state.window = with_position(state.window, sample.position_device_m);
    if (sample.drive.is_one()) {
        const Vec3 foot_device_m = sample.position_device_m - sample.drive.length_m * sample.drive.along_device;
        const bool follows = state.window.count > 1 && gap_s > 0.0;
        state.foot_velocity_device_m_per_s = follows ? (foot_device_m - state.foot_device_m) / gap_s : Vec3(0.0);
        state.foot_device_m = foot_device_m;
    }
    state.sample_ns = sample.time_ns;
    if (turns) {
        const VelocityWindow& w = state.turning;
        const Vec3 turned =
            w.count == 0 ? Vec3(0.0)
                         : w.positions_m[w.newest] + turn_between(state.orientation_device, sample.orientation_device);
        state.turning = with_position(w, turned);
    }
    state.orientation_device = sample.orientation_device;
    return state;
}

// The workspace is where a device is at its best; its arm reaches farther. Nothing on a desk reaches kBeyond farther,
// and a device whose workspace is not known is no farther than kAnywhere from its origin.
bool within_reach(const Vec3& position_device_m, const devices::DeviceDescription& device) {
    constexpr double kBeyond_m = 0.5, kAnywhere_m = 10.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double width_m = device.workspace_m[axis];
        const double most_m = width_m > 0.0 ? 0.5 * width_m + kBeyond_m : kAnywhere_m;
        if (!(std::abs(position_device_m[axis]) <= most_m)) return false;
    }
    return true;
}

void end_contact(ProbeState& state) {
    for (ProxyState& proxy : state.proxies) proxy.placed = false;
    state.watches = {};
    state.cutting.engaged = false;
}

// Where a tick puts its results, six kilobytes that full_tick() would otherwise copy.
struct TickResult {
    TickState& next;  // holds the state before
    TickRecord& record;
};

// The tick of input that makes no sense. After a few of them contact starts afresh; after a single one it goes on, for
// a ball that is pressed into a groove may not fit there when it is set anew. The velocity starts afresh in any case,
// for a sample is missing then (with_sample).
void refuse(const TickResult& t) {
    constexpr std::uint32_t kMostRefused = 10;
    if (++t.next.refused > kMostRefused) end_contact(t.next.probe);
    // The last known position of the tool.
    const Vec3 last_object_m = t.next.probe.proxies[0].position_object_m;
    t.next.passivity.known = false;
    t.next.force = {};
    t.record.contact.point_count = 1;
    t.record.contact.points[0].hip_object_m = t.record.contact.points[0].proxy_object_m = last_object_m;
    t.record.motion.object_from_device = t.next.workspace.object_from_device;
}

bool sensible(const devices::OneWayDrive& drive) {
    if (!drive.is_one()) return true;
    const double squared = glm::dot(drive.along_device, drive.along_device);
    return std::abs(squared - 1.0) <= 2e-6 && finite(drive.moves_device) && not_negative(drive.length_m);
}

// How fast the touched surface would have a drive of one way change its length. Against the surface moves also the
// drive's foot, with the palm: as a body's way, that is none of the drive's own.
double surface_along_drive_m_per_s(const TickRecord& record, const Vec3& pressing_device_N, const MotionState& motion) {
    const double moved = along_drive_N(pressing_device_N, record.sample.drive);
    if (!(moved > 0.0)) return 0.0;
    const Vec3 way = record.contact.surface_velocity_device_m_per_s - motion.foot_velocity_device_m_per_s;
    return glm::dot(pressing_device_N, way) / moved;
}

// Has the passivity controller see a drive of one way along itself.
void turn_along(PassivityInput& input, const TickRecord& record, const Vec3& pressing_device_N,
                const MotionState& motion) {
    const devices::OneWayDrive& drive = record.sample.drive;
    input.one_way = true;
    input.window = nullptr;
    input.position_device_m = Vec3(drive.length_m, 0.0, 0.0);
    input.wanted.force_device_N = Vec3(glm::dot(input.wanted.force_device_N, drive.along_device), 0.0, 0.0);
    input.surface_velocity_device_m_per_s =
        Vec3(surface_along_drive_m_per_s(record, pressing_device_N, motion), 0.0, 0.0);
}

// Applies the passivity controller to the contact's wrench; pressing_device_N: its force before a drive of one way took
// it.
PassivityStep kept_passive(const PassivityObserver& state, const TickRecord& record, const Vec3& pressing_device_N,
                           const MotionState& motion, const TickParameters& parameters,
                           const devices::DeviceDescription& device, double dt_s) {
    PassivityInput input;
    input.time_ns = record.sample.time_ns;
    input.now_ns = record.time_ns;
    input.position_device_m = record.sample.position_device_m;
    input.orientation_device = record.sample.orientation_device;
    input.window = &motion.window;
    input.turns = device.max_torque_Nm != Vec3(0.0);
    input.wanted = driven_part(record.contact.wrench, device);
    input.stored_J = record.contact.spring_energy_J;
    input.max_force_N = std::min(parameters.limits.max_force_N, device.max_force_N);
    input.in_contact = record.in_contact();
    input.jumped = record.contact.jumped || record.contact.eases;
    input.surface_velocity_device_m_per_s = record.contact.surface_velocity_device_m_per_s;
    const devices::OneWayDrive& drive = record.sample.drive;
    if (!drive.is_one()) return keep_passive(state, input, parameters.passivity, device, dt_s);
    turn_along(input, record, pressing_device_N, motion);
    PassivityStep step = keep_passive(state, input, parameters.passivity, device, dt_s);
    step.wrench.force_device_N = step.wrench.force_device_N.x * drive.along_device;
    return step;
}

// Eases the contact's force where it has changed otherwise than by the motion of hand and bodies. After a jump from
// free space the gate fades it in.
void ease_contact(EasedForce& state, TickRecord& record, bool ended, const TickParameters& parameters, double dt_s) {
    ContactRecord& contact = record.contact;
    const devices::DeviceWrench& last = state.last.wrench;
    const bool had_force = last.force_device_N != Vec3(0.0) || last.torque_device_Nm != Vec3(0.0);
    double changed_s = 0.0;
    if (had_force && contact.jumped)
        changed_s = std::max(parameters.limits.contact_ramp_s, dt_s);
    else if (contact.edited || ended)
        changed_s = kEase_s;
    const ContactForce force = eased(state, {contact.wrench, contact.spring_energy_J}, changed_s, dt_s);
    contact.wrench = force.wrench;
    contact.spring_energy_J = force.stored_J;
    contact.eases = state.changes();
    if (contact.eases) record.flags |= kTickRamping;
}

GuidanceStep guided(const GuidanceState& state, const TickRecord& record, const TickParameters& parameters,
                    double dt_s) {
    if (!(parameters.guidance.stiffness_N_per_m > 0.0)) return {};
    const MotionRecord& motion = record.motion;
    std::array<GuidedPoint, kMostProbePoints> points;
    const std::uint32_t count = record.contact.point_count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3& offset_m = parameters.probe.points[i].offset_device_m;
        points[i] = {record.contact.points[i].hip_object_m, offset_m, record.sample.orientation_device * offset_m};
    }
    return guide(state,
                 {{points.data(), count},
                  motion.velocity_device_m_per_s,
                  motion.angular_velocity_device_rad_per_s,
                  motion.object_from_device.orientation,
                  motion.object_from_device.scale,
                  dt_s},
                 parameters.curve, parameters.guidance);
}

// Returns the stroke in free flight that lasts in this tick.
FreeFill with_button(const TickState& state, const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
                     const TickParameters& parameters) {
    const FreeFill& before = state.free_fill;
    FreeFill now = before;
    now.pressed = (sample.buttons & 1u) != 0;
    const bool fills = parameters.action == ToolAction::fill && parameters.fills != FillPlace::surface;
    const bool begins = now.pressed && !before.pressed && !state.in_contact;
    if (fills && now.pressed && (parameters.fills == FillPlace::hand || begins)) now.lasts = true;
    // Another tool in a hand that feels nothing works at once, though it is within what was added.
    if (!fills && now.pressed && parameters.fills == FillPlace::hand) now.lasts = false;
    if (before.pressed && !now.pressed) now.ended_sequence = surface.sequence;
    return now;
}

// Tells whether the stroke has ended and the surface holds all that it has added: that of the update which was on its
// way when the button came up does not.
bool is_over(const FreeFill& fill, const geometry::LocalSurface& surface) {
    constexpr std::uint64_t kSurfacesLater = 2;
    return fill.lasts && !fill.pressed && surface.sequence >= fill.ended_sequence + kSurfacesLater;
}

void compute_tick(const TickResult& t, const TickState& state, const devices::DeviceSample& sample,
                  const geometry::LocalSurface& surface, const TickParameters& parameters,
                  const devices::DeviceDescription& device, Nanoseconds now_ns, double dt_s) {
    TickState& next = t.next;
    TickRecord& record = t.record;
    record.time_ns = now_ns;
    record.sample = sample;
    record.surface_sequence = surface.sequence;
    record.parameter_sequence = parameters.sequence;
    record.sample_finite =
        finite(sample.position_device_m) && unit(sample.orientation_device) && sensible(sample.drive);
    record.parameters_sensible = parameters_are_sensible(parameters) && materials_are_known(surface);
    record.scale_felt = is_felt_at(parameters.workspace.object_from_device.scale);
    record.within_reach = within_reach(sample.position_device_m, device);
    const bool ahead = seconds(sample.time_ns - now_ns) > parameters.limits.max_ahead_s;
    if (!record.sample_finite || !record.parameters_sensible || !record.scale_felt || !record.within_reach || ahead)
        return refuse(t);

    next.refused = 0;
    // Motion of the hand.
    MotionRecord& motion = record.motion;
    const bool turns = parameters.probe.count > 1;
    next.motion = with_sample(state.motion, sample, turns, dt_s);
    const VelocityEstimate estimate = estimate_velocity(
        parameters.signals, next.motion.window, next.motion.velocity_average, parameters.position_noise_m, dt_s);
    next.motion.velocity_average = estimate.average;
    motion.velocity_device_m_per_s = estimate.velocity_m_per_s;
    if (turns) motion.angular_velocity_device_rad_per_s = velocity_m_per_s(next.motion.turning, kTurnNoise_rad, dt_s);

    // Mapping into the scene by the workspace technique.
    const WorkspaceStep workspace = step_workspace(
        state.workspace, parameters.workspace,
        {sample.position_device_m, motion.velocity_device_m_per_s, sample.buttons, state.in_contact, dt_s});
    next.workspace = workspace.next;
    motion.object_from_device = workspace.object_from_device;
    motion.piece = workspace.piece;
    motion.orientation_object = workspace.object_from_device.orientation * sample.orientation_device;
    motion.workspace = workspace.picture;
    if (workspace.paused) record.flags |= kTickPaused;

    // Contact; it starts afresh after a jump of the mapping.
    const bool lifted = parameters.touches_while_pressed && (sample.buttons & 1u) == 0;
    next.free_fill = with_button(state, sample, surface, parameters);
    const bool away = workspace.jumped || workspace.paused || parameters.holds;
    if (away || !parameters.enabled || lifted || next.free_fill.lasts) end_contact(next.probe);
    if (!next.probe.proxies[0].placed) record.flags |= kTickProxyReset;
    const bool searchable = surface.sequence > 0;
    if (!searchable) record.flags |= kTickNoSurface;
    const ProbeInput input{sample, motion, surface, parameters, device, dt_s, now_ns, record.turn};
    const ProbeStep probe{next.probe, record.contact, record.flags};
    if (searchable && is_over(next.free_fill, surface) && fits_at_hand(probe, input)) next.free_fill.lasts = false;
    const bool untouched = lifted || next.free_fill.lasts;
    const bool touches = searchable && parameters.enabled && !parameters.holds && !workspace.paused && !untouched;
    const bool places = touches && parameters.placement.number != next.probe.placement;
    if (places) {
        place_proxies(next.probe, parameters.placement.position_object_m, surface.sequence);
        next.probe.placement = parameters.placement.number;
    }
    if (touches)
        touch_surface(probe, input);
    else
        follow_hand(probe, input);
    if (places) record.contact.jumped = true;
    next.in_contact = record.in_contact();
    const double age_s = seconds(now_ns - surface.made_ns);
    if (next.in_contact && parameters.max_surface_age_s > 0.0 && age_s > parameters.max_surface_age_s)
        record.flags |= kTickStaleSurface;

    // The chosen force filter, then the passivity controller.
    devices::DeviceWrench& contact = record.contact.wrench;
    const double alpha = parameters.signals.force_alpha;
    next.force_average = with_input(state.force_average, contact.force_device_N, alpha);
    if (alpha > 0.0) contact.force_device_N = next.force_average.value;
    // What the watch lets go is zero for safety, and does not come back.
    if (parameters.enabled && !untouched && (record.flags & kTickLetGo) == 0)
        ease_contact(next.force, record, away && state.in_contact, parameters, dt_s);
    else
        next.force = {};
    const Vec3 pressing_device_N = contact.force_device_N;
    contact = as_driven(contact, sample.drive);
    const PassivityStep passive =
        kept_passive(state.passivity, record, pressing_device_N, next.motion, parameters, device, dt_s);
    next.passivity = passive.next;
    record.passivity = passive.record;
    contact.force_device_N = passive.wrench.force_device_N;
    contact.torque_device_Nm *= passive.record.share;
    if (passive.record.damping_Ns_per_m > 0.0 || passive.record.share < 1.0) record.flags |= kTickPassivityActs;

    // Forces that act in free space too: the tool's weight, guidance, the workspace's elastic border.
    devices::DeviceWrench others = weight_wrench(parameters.weight, sample.orientation_device);
    const GuidanceStep guidance = guided(state.guidance, record, parameters, dt_s);
    next.guidance = guidance.next;
    if (guidance.next.held) record.flags |= kTickGuided;
    others.force_device_N += guidance.force_device_N + workspace.force_device_N;
    others.torque_device_Nm += guidance.torque_device_Nm;
    if (sample.drive.is_one()) {
        const double sum_N = glm::dot(contact.force_device_N, sample.drive.along_device) +
                             along_drive_N(others.force_device_N, sample.drive);
        record.wanted = {std::max(0.0, sum_N) * sample.drive.along_device, Vec3(0.0)};
        return;
    }
    record.wanted = driven_part(
        {contact.force_device_N + others.force_device_N, contact.torque_device_Nm + others.torque_device_Nm}, device);
}

}  // namespace

Tick tick(const TickState& state, const devices::DeviceSample& sample, const geometry::LocalSurface& surface,
          const TickParameters& parameters, const devices::DeviceDescription& device, Nanoseconds now_ns,
          double dt_s) noexcept {
    Tick t{state, {}};
    compute_tick({t.next, t.record}, state, sample, surface, parameters, device, now_ns, dt_s);
    return t;
}

GateInput gate_input(const TickRecord& record, const devices::DeviceDescription& device) noexcept {
    GateInput in;
    in.wanted = record.wanted;
    in.velocity_device_m_per_s = record.motion.velocity_device_m_per_s;
    // What the energy account does not afford may not be held up by the slew limit either.
    const Vec3 others = record.wanted.force_device_N - record.contact.wrench.force_device_N;
    in.device_max_force_N = std::min(device.max_force_N, record.passivity.most_N + std::sqrt(glm::dot(others, others)));
    in.device_axis_max_force_N = device.axis_max_force_N;
    in.device_max_torque_Nm = device.max_torque_Nm;
    in.drives_device = record.sample.drive.along_device;
    const Vec3 turning = record.wanted.torque_device_Nm - driven_part(record.contact.wrench, device).torque_device_Nm;
    in.most_torque_Nm = record.passivity.most_Nm + std::sqrt(glm::dot(turning, turning));
    in.sample_age_s = seconds(record.time_ns - record.sample.time_ns);
    in.device_fault = record.sample.fault;
    in.sample_finite = record.sample_finite;
    in.within_reach = record.within_reach;
    in.parameters_sensible = record.parameters_sensible;
    in.scale_felt = record.scale_felt;
    in.in_contact = record.in_contact();
    in.contact_jumped = record.contact.jumped && !record.contact.eases;
    in.surface_stale = (record.flags & kTickStaleSurface) != 0;
    in.outside_known = (record.flags & kTickOutsideKnown) != 0;
    in.let_go = (record.flags & kTickLetGo) != 0;
    return in;
}

FullTick full_tick(const FullTickState& state, const devices::DeviceSample& sample,
                   const geometry::LocalSurface& surface, const TickParameters& parameters,
                   const devices::DeviceDescription& device, Nanoseconds now_ns, double dt_s,
                   const TurnShare& turn) noexcept {
    FullTick full{{state.tick, {}, now_ns}, {}};
    TickRecord& record = full.record;
    record.turn = turn;
    compute_tick({full.next.tick, record}, state.tick, sample, surface, parameters, device, now_ns, dt_s);
    GateInput input = gate_input(record, device);
    if (state.now_ns > 0) input.loop_gap_s = seconds(now_ns - state.now_ns);
    input.promised_gap_s = promised_gap_s(parameters.passivity, device, dt_s);
    const GateStep gate = pass_gate(state.gate, input, parameters.limits, dt_s);
    full.next.gate = gate.next;
    record.gate = gate.output;
    const bool on = record.gate.cause == GateCause::none;
    if (!on) record.flags |= kTickFault;
    if (record.gate.saturated) record.flags |= kTickForceSaturated;
    if (record.gate.slew_limited) record.flags |= kTickSlewLimited;
    if (record.gate.ramping) record.flags |= kTickRamping;
    if (input.loop_gap_s > 1.5 * dt_s) record.flags |= kTickLoopGap;
    // The passivity controller accounts for the contact only, so what the gate let through of the rest is subtracted.
    devices::DeviceWrench given;
    if (on) {
        const devices::DeviceWrench contact = driven_part(record.contact.wrench, device);
        const double faded = gate.next.faded();
        given.force_device_N =
            record.gate.given.force_device_N - faded * (record.wanted.force_device_N - contact.force_device_N);
        given.torque_device_Nm =
            record.gate.given.torque_device_Nm - faded * (record.wanted.torque_device_Nm - contact.torque_device_Nm);
    }
    if (sample.drive.is_one())
        given.force_device_N = Vec3(glm::dot(given.force_device_N, sample.drive.along_device), 0.0, 0.0);
    set_commanded_wrench(full.next.tick.passivity, given, now_ns);
    return full;
}

}  // namespace burin::haptics
