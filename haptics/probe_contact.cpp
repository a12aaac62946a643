// SPDX-License-Identifier: MIT
#include "haptics/probe_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "haptics/forces/touch_force.hpp"

namespace burin {
namespace {

// A contact that moves farther than this in one tick, at the device, is not the same contact: it fades in.
constexpr double kJump_m = 0.0005;

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

// The wall as the device may render it: through the coupling, and no stiffer than it stays passive. Points that touch at once
// are springs side by side, whose stiffness adds up where their normals agree: each gets its share of what is allowed.
CoupledWall rendered(TickOutput& out, const TouchMaterial& material, const TickParameters& parameters,
                     const DeviceDescription& device, std::uint32_t points_in_contact, double dt_s) {
    CoupledWall wall = through(parameters.coupling, {material.stiffness_N_per_m, material.damping_Ns_per_m});
    if (!parameters.limit_stiffness) return wall;
    const double points = std::max(points_in_contact, 1u);
    ContactDemand demand;
    demand.stiffness_N_per_m = wall.stiffness_N_per_m * points;
    demand.damping_Ns_per_m = wall.damping_Ns_per_m * points;
    const double alpha = parameters.signals.force_alpha;
    demand.filter_lag_s = mean_lag_s(alpha, dt_s);
    demand.period_s = dt_s;
    const StiffnessLimit limit = limited(demand, device);
    if (limit.bound != StiffnessBound::none) {
        out.flags |= kTickStiffnessLimited;
        out.stiffness_bound = limit.bound;
    }
    return {limit.stiffness_N_per_m / points, limit.damping_Ns_per_m / points};
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

// What earlier points have left of the tick's work is shared by those still to come.
ProxyBudget share_of_rest(const TickOutput& out, std::uint32_t point) {
    ProxyBudget budget;
    const std::uint32_t sharing = out.point_count - point;
    budget.max_triangles_tested = (budget.max_triangles_tested - out.work.triangles_tested) / sharing;
    budget.max_triangles_seen = (budget.max_triangles_seen - out.work.triangles_seen) / sharing;
    return budget;
}

void note_deepest(TickOutput& out) {
    for (std::uint32_t i = 1; i < out.point_count; ++i)
        if (out.points[i].penetration_m > out.points[out.deepest].penetration_m) out.deepest = i;
}

}  // namespace

DeviceWrench touch_surface(TickOutput& out, const DeviceSample& sample, const LocalSurface& surface,
                           const TickParameters& parameters, const DeviceDescription& device, double dt_s) noexcept {
    const bool pressed = (sample.buttons & 1u) != 0;
    const bool painting = pressed && parameters.action == ToolAction::paint;
    const bool cutting = pressed && parameters.action == ToolAction::cut;
    std::array<std::optional<PointContact>, kMostProbePoints> points;
    std::uint32_t in_contact = 0;
    for (std::uint32_t i = 0; i < out.point_count; ++i) {
        points[i].emplace(out, sample, surface, parameters, i).touch(painting, share_of_rest(out, i));
        if (points[i]->in_contact()) ++in_contact;
    }
    std::array<PointForce, kMostProbePoints> forces;
    Vec3 drag_device_N(0.0);
    for (std::uint32_t i = 0; i < out.point_count; ++i) {
        PointContact& point = *points[i];
        const CoupledWall wall = rendered(out, point.material(), parameters, device, in_contact, dt_s);
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

void follow_hand(TickOutput& out, const DeviceSample& sample, const LocalSurface& surface,
                 const TickParameters& parameters) noexcept {
    for (std::uint32_t i = 0; i < out.point_count; ++i)
        PointContact(out, sample, surface, parameters, i).stay_with_hand();
    out.cut_object_m = out.points[0].hip_object_m;
}

}  // namespace burin
