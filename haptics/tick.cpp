// SPDX-License-Identifier: MIT
#include "haptics/tick.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/forces/touch_force.hpp"

namespace burin {
namespace {

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool unit(const Quat& q) {
    // A comparison that a NaN fails.
    return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-6;
}

// A contact that moves farther than this in one tick, at the device, is not the same contact: it fades in.
constexpr double kJump_m = 0.0005;

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

// Contact of one point: where its proxy goes, and what that cost.
class PointContact {
public:
    PointContact(TickOutput& out, const DeviceSample& sample, const LocalSurface& surface,
                 const TickParameters& parameters, std::uint32_t index)
        : out_(out),
          surface_(surface),
          parameters_(parameters),
          point_(parameters.probe.points[index]),
          state_(out.next.proxies[index]),
          material_(out.next.materials[index]),
          record_(out.points[index]) {
        arm_device_m_ = sample.orientation_device * point_.offset_device_m;
        velocity_device_m_per_s_ = out.velocity_device_m_per_s;
        if (parameters.probe.count > 1)
            velocity_device_m_per_s_ += glm::cross(out.angular_velocity_device_rad_per_s, arm_device_m_);
        record_.hip_object_m = out.object_from_device * (sample.position_device_m + arm_device_m_);
        record_.proxy_object_m = record_.hip_object_m;
    }

    void stay_with_hand() { state_ = {record_.hip_object_m, surface_.sequence, false}; }

    void touch(bool painting, const ProxyBudget& budget) {
        const bool was_placed = state_.placed;
        const Vec3 before = state_.position_object_m;
        const ProxyResult moved = move_proxy(state_, record_.hip_object_m, settings(painting), surface_, budget);
        state_ = moved.next;
        keep_work(moved);
        record_.proxy_object_m = moved.next.position_object_m;
        const Vec3 reach = record_.proxy_object_m - surface_.center_object;
        if (!(std::sqrt(glm::dot(reach, reach)) + radius_m() <= surface_.radius_m)) out_.flags |= kTickOutsideKnown;
        const Vec3 spring = record_.proxy_object_m - record_.hip_object_m;
        const double depth = std::sqrt(glm::dot(spring, spring));
        if (moved.active_triangle != kNoTriangle) material_ = surface_.material(moved.active_triangle);
        if (moved.constraints == 0 || !(depth > 0.0) || !material().enabled) return;
        out_.flags |= kTickInContact;
        if (moved.sticking) out_.flags |= kTickSticking;
        record_.constraints = moved.constraints;
        record_.active_triangle = moved.active_triangle;
        record_.penetration_m = depth;
        record_.normal_object = moved.normal_object;
        const Vec3 jump = record_.proxy_object_m - before;
        const double jump_m = kJump_m * out_.object_from_device.scale;
        if (!was_placed || (moved.pushed_out && glm::dot(jump, jump) > jump_m * jump_m)) out_.contact_jumped = true;
    }

    [[nodiscard]] bool in_contact() const { return record_.constraints > 0; }
    // The material of the tick before until this one has touched: friction changes a tick late where two meet.
    [[nodiscard]] const TouchMaterial& material() const {
        return parameters_.materials[std::min<std::uint32_t>(material_, kMostMaterials - 1)];
    }
    [[nodiscard]] double radius_m() const { return point_.radius_m * (1.0 - parameters_.clearance_ratio); }
    [[nodiscard]] const PointRecord& record() const { return record_; }

    // What the hand feels of it, borne at the proxy, or where the tool has eaten to.
    [[nodiscard]] PointForce force(const CoupledWall& wall, const Vec3& bearing_object_m) {
        if (in_contact()) {
            const Similarity& map = out_.object_from_device;
            record_.force_device_N = touch_force_device({record_.hip_object_m, bearing_object_m, record_.normal_object,
                                                         velocity_device_m_per_s_, map.orientation, map.scale,
                                                         wall.stiffness_N_per_m, wall.damping_Ns_per_m});
        }
        return {arm_device_m_, record_.force_device_N};
    }

    // What the wall's spring holds of it.
    [[nodiscard]] double spring_energy_J(const CoupledWall& wall, const Vec3& bearing_object_m) const {
        if (!in_contact()) return 0.0;
        const Vec3 spring_device_m = (bearing_object_m - record_.hip_object_m) / out_.object_from_device.scale;
        return 0.5 * wall.stiffness_N_per_m * glm::dot(spring_device_m, spring_device_m);
    }

private:
    [[nodiscard]] ProxySettings settings(bool painting) const {
        ProxySettings s;
        s.contact_radius_m = radius_m();
        s.shading = parameters_.shading;
        if (painting) return s;
        const double speed = std::sqrt(glm::dot(velocity_device_m_per_s_, velocity_device_m_per_s_));
        const FrictionCone cone = friction_at(material(), speed);
        s.static_friction = cone.static_friction;
        s.dynamic_friction = cone.dynamic_friction;
        return s;
    }

    void keep_work(const ProxyResult& moved) {
        out_.work.triangles_tested += moved.work.triangles_tested;
        out_.work.triangles_seen += moved.work.triangles_seen;
        out_.work.proxy_steps += moved.work.steps;
        out_.work.plane_solves += moved.work.plane_solves;
        if (moved.pushed_out) out_.flags |= kTickPushedOut;
        if (moved.work_limited) out_.flags |= kTickWorkLimited;
    }

    TickOutput& out_;
    const LocalSurface& surface_;
    const TickParameters& parameters_;
    const ProbePoint& point_;
    ProxyState& state_;
    std::uint8_t& material_;
    PointRecord& record_;
    Vec3 arm_device_m_{0.0}, velocity_device_m_per_s_{0.0};
};

// The wall as the device may render it: through the coupling, and no stiffer than it stays passive.
CoupledWall rendered(TickOutput& out, const TouchMaterial& material, const TickParameters& parameters,
                     const DeviceDescription& device, double dt_s) {
    CoupledWall wall = through(parameters.coupling, {material.stiffness_N_per_m, material.damping_Ns_per_m});
    if (!parameters.limit_stiffness) return wall;
    ContactDemand demand;
    demand.stiffness_N_per_m = wall.stiffness_N_per_m;
    demand.damping_Ns_per_m = wall.damping_Ns_per_m;
    const double alpha = parameters.signals.force_alpha;
    demand.filter_lag_s = mean_lag_s(alpha, dt_s);
    demand.period_s = dt_s;
    const StiffnessLimit limit = limited(demand, device);
    if (limit.bound != StiffnessBound::none) {
        out.flags |= kTickStiffnessLimited;
        out.stiffness_bound = limit.bound;
    }
    return {limit.stiffness_N_per_m, limit.damping_Ns_per_m};
}

// While the button cuts, the tool eats its way in, and is borne by what it has not cut yet.
Vec3 bearing_of(TickOutput& out, const PointContact& point, const CoupledWall& wall, bool cutting,
                const LocalSurface& surface, const TickParameters& parameters, Vec3& drag_device_N, double dt_s) {
    CuttingInput input;
    input.hip_object_m = point.record().hip_object_m;
    input.proxy_object_m = point.record().proxy_object_m;
    input.normal_object = point.record().normal_object;
    input.velocity_device_m_per_s = out.velocity_device_m_per_s;
    input.scale = out.object_from_device.scale;
    input.tool_radius_m = parameters.probe.points[0].radius_m;
    input.slack_m = parameters.clearance_ratio * input.tool_radius_m;
    input.cutting = cutting && point.in_contact();
    input.stiffness_N_per_m = wall.stiffness_N_per_m;
    input.dt_s = dt_s;
    if (input.cutting) {
        const LookedAt looked = look_at(out.next.cutting, input, surface);
        out.next.cutting = looked.next;
        out.work.triangles_seen += looked.triangles_seen;
    }
    const CuttingStep step = cut(out.next.cutting, input, point.material());
    out.next.cutting = step.next;
    if (step.next.engaged) out.flags |= kTickCutting;
    drag_device_N = step.drag_device_N;
    out.cut_object_m = step.bearing_object_m;
    return step.bearing_object_m;
}

void note_deepest(TickOutput& out) {
    for (std::uint32_t i = 1; i < out.point_count; ++i)
        if (out.points[i].penetration_m > out.points[out.deepest].penetration_m) out.deepest = i;
}

// Every point on the surface: what the hand feels of it together.
DeviceWrench touch_surface(TickOutput& out, const DeviceSample& sample, const LocalSurface& surface,
                           const TickParameters& parameters, const DeviceDescription& device, double dt_s) {
    const bool pressed = (sample.buttons & 1u) != 0;
    const bool painting = pressed && parameters.action == ToolAction::paint;
    const bool cutting = pressed && parameters.action == ToolAction::cut;
    std::array<PointForce, kMostProbePoints> forces;
    Vec3 drag_device_N(0.0);
    for (std::uint32_t i = 0; i < out.point_count; ++i) {
        PointContact point(out, sample, surface, parameters, i);
        ProxyBudget budget;
        budget.max_triangles_tested /= out.point_count;
        budget.max_triangles_seen /= out.point_count;
        point.touch(painting, budget);
        const CoupledWall wall = rendered(out, point.material(), parameters, device, dt_s);
        Vec3 bearing = point.record().proxy_object_m;
        if (i == 0) bearing = bearing_of(out, point, wall, cutting, surface, parameters, drag_device_N, dt_s);
        forces[i] = point.force(wall, bearing);
        out.spring_energy_J += point.spring_energy_J(wall, bearing);
    }
    note_deepest(out);
    DeviceWrench sum = sum_of({forces.data(), out.point_count});
    sum.force_device_N += drag_device_N;
    return sum;
}

// Nothing is touched: the proxies stay with the hand.
void follow_hand(TickOutput& out, const DeviceSample& sample, const LocalSurface& surface,
                 const TickParameters& parameters) {
    for (std::uint32_t i = 0; i < out.point_count; ++i)
        PointContact(out, sample, surface, parameters, i).stay_with_hand();
    out.cut_object_m = out.points[0].hip_object_m;
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
