// SPDX-License-Identifier: MIT
#include "haptics/probe_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "haptics/forces/touch_force.hpp"

namespace burin::haptics {
namespace {

// A contact that moves farther than this in one tick, at the device, counts as a new contact: its force fades in.
constexpr double kJump_m = 0.0005;

// Contact of one point of the probe: the motion of its proxy and the work it took.
class PointContact {
public:
    // Records into `step`, which must outlive the object.
    PointContact(const ProbeInput& input, const ProbeStep& step, std::uint32_t index)
        : input_(input),
          step_(step),
          point_(input.parameters.probe.points[index]),
          state_(step.next.proxies[index]),
          material_(step.next.materials[index]),
          record_(step.contact.points[index]) {
        const MotionRecord& motion = input.motion;
        arm_device_m_ = input.sample.orientation_device * point_.offset_device_m;
        velocity_device_m_per_s_ = motion.velocity_device_m_per_s;
        if (input.parameters.probe.count > 1)
            velocity_device_m_per_s_ += glm::cross(motion.angular_velocity_device_rad_per_s, arm_device_m_);
        record_.hip_object_m = motion.object_from_device * (input.sample.position_device_m + arm_device_m_);
        record_.proxy_object_m = record_.hip_object_m;
    }

    void stay_with_hand() { state_ = {record_.hip_object_m, input_.surface.sequence, false}; }

    void touch(bool painting, const ProxyBudget& budget) {
        const bool was_placed = state_.placed;
        const Vec3 before = state_.position_object_m;
        const ProxyResult moved = move_proxy(state_, record_.hip_object_m, settings(painting), input_.surface, budget);
        state_ = moved.next;
        count_work(moved);
        record_.proxy_object_m = moved.next.position_object_m;
        const Vec3 reach = record_.proxy_object_m - input_.surface.center_object;
        if (!(std::sqrt(glm::dot(reach, reach)) + radius_m() <= input_.surface.radius_m))
            step_.flags |= kTickOutsideKnown;
        const Vec3 spring = record_.proxy_object_m - record_.hip_object_m;
        const double depth = std::sqrt(glm::dot(spring, spring));
        if (moved.active_triangle != kNoTriangle) material_ = input_.surface.material(moved.active_triangle);
        if (moved.constraints == 0 || !(depth > 0.0) || !material().enabled) return;
        step_.flags |= kTickInContact;
        if (moved.sticking) step_.flags |= kTickSticking;
        record_.constraints = moved.constraints;
        record_.active_triangle = moved.active_triangle;
        record_.penetration_m = depth;
        record_.normal_object = moved.normal_object;
        const Vec3 jump = record_.proxy_object_m - before;
        const double jump_m = kJump_m * input_.motion.object_from_device.scale;
        if (!was_placed || (moved.pushed_out && glm::dot(jump, jump) > jump_m * jump_m)) step_.contact.jumped = true;
    }

    [[nodiscard]] bool in_contact() const { return record_.constraints > 0; }
    // The material touched in the last tick until this one has touched: at a border friction changes a tick late.
    [[nodiscard]] const TouchMaterial& material() const {
        return input_.parameters.materials[std::min<std::uint32_t>(material_, kMostMaterials - 1)];
    }
    [[nodiscard]] double radius_m() const { return point_.radius_m * (1.0 - input_.parameters.clearance_ratio); }
    [[nodiscard]] const PointRecord& record() const { return record_; }
    [[nodiscard]] double squared_arm_m2() const { return glm::dot(arm_device_m_, arm_device_m_); }

    // The force of this point on the hand, borne at the proxy or at the cutting point.
    [[nodiscard]] PointForce force(const CoupledWall& wall, const Vec3& bearing_object_m) {
        if (in_contact()) {
            const Similarity& map = input_.motion.object_from_device;
            record_.force_device_N = touch_force_device({record_.hip_object_m, bearing_object_m, record_.normal_object,
                                                         velocity_device_m_per_s_, map.orientation, map.scale,
                                                         wall.stiffness_N_per_m, wall.damping_Ns_per_m});
        }
        return {arm_device_m_, record_.force_device_N};
    }

    // Energy stored in the wall's spring at this point.
    [[nodiscard]] double spring_energy_J(const CoupledWall& wall, const Vec3& bearing_object_m) const {
        if (!in_contact()) return 0.0;
        const Vec3 spring_device_m = (bearing_object_m - record_.hip_object_m) / input_.motion.object_from_device.scale;
        return 0.5 * wall.stiffness_N_per_m * glm::dot(spring_device_m, spring_device_m);
    }

private:
    [[nodiscard]] ProxySettings settings(bool painting) const {
        ProxySettings s;
        s.contact_radius_m = radius_m();
        s.shading = input_.parameters.shading;
        if (painting) return s;
        const double speed = std::sqrt(glm::dot(velocity_device_m_per_s_, velocity_device_m_per_s_));
        const FrictionCone cone = friction_at(material(), speed);
        s.static_friction = cone.static_friction;
        s.dynamic_friction = cone.dynamic_friction;
        return s;
    }

    void count_work(const ProxyResult& moved) {
        step_.contact.work += moved.work;
        if (moved.pushed_out) step_.flags |= kTickPushedOut;
        if (moved.work_limited) step_.flags |= kTickWorkLimited;
    }

    const ProbeInput& input_;
    const ProbeStep& step_;
    const ProbePoint& point_;
    ProxyState& state_;
    std::uint8_t& material_;
    PointRecord& record_;
    Vec3 arm_device_m_{0.0}, velocity_device_m_per_s_{0.0};
};

struct RenderedWall {
    CoupledWall wall;
    StiffnessBound bound = StiffnessBound::none;  // why it is softer than the material
};

// The points that touch at once.
struct Touching {
    std::uint32_t points = 0;
    double squared_arms_m2 = 0.0;  // sum; 0 with one point
};

// The wall as the device may render it: through the coupling, and limited to the stiffness at which it stays passive.
// Points that touch at once are parallel springs whose stiffnesses add up where their normals agree, so each gets its
// share of the limit; and so does the resistance to rotation that they make up together.
RenderedWall rendered(const TouchMaterial& material, const ProbeInput& input, const Touching& touching) {
    const TickParameters& parameters = input.parameters;
    const CoupledWall wall = through(parameters.coupling, {material.stiffness_N_per_m, material.damping_Ns_per_m});
    if (!parameters.limit_stiffness) return {wall};
    const double points = std::max(touching.points, 1u);
    ContactDemand demand;
    demand.stiffness_N_per_m = wall.stiffness_N_per_m * points;
    demand.damping_Ns_per_m = wall.damping_Ns_per_m * points;
    demand.filter_lag_s = mean_lag_s(parameters.signals.force_alpha, input.dt_s);
    demand.period_s = input.dt_s;
    const StiffnessLimit limit = limited(demand, input.device);
    const CoupledWall each{limit.stiffness_N_per_m / points, limit.damping_Ns_per_m / points};
    if (!(touching.squared_arms_m2 > 0.0)) return {each, limit.bound};
    demand.stiffness_N_per_m = each.stiffness_N_per_m;
    demand.damping_Ns_per_m = each.damping_Ns_per_m;
    const StiffnessLimit turning = limited_by_rotation(demand, touching.squared_arms_m2, input.device);
    return {{turning.stiffness_N_per_m, turning.damping_Ns_per_m},
            turning.bound != StiffnessBound::none ? turning.bound : limit.bound};
}

struct CutByPoint {
    CuttingStep step;
    std::uint32_t triangles_seen = 0;
};

// Advances the cutting point with the probe's first point.
CutByPoint cut_by(const PointContact& point, const CuttingState& state, const CoupledWall& wall, bool cutting,
                  const ProbeInput& in) {
    CuttingInput input;
    input.hip_object_m = point.record().hip_object_m;
    input.proxy_object_m = point.record().proxy_object_m;
    input.normal_object = point.record().normal_object;
    input.velocity_device_m_per_s = in.motion.velocity_device_m_per_s;
    input.scale = in.motion.object_from_device.scale;
    input.tool_radius_m = in.parameters.probe.points[0].radius_m;
    input.slack_m = in.parameters.clearance_ratio * input.tool_radius_m;
    input.cutting = cutting && point.in_contact();
    input.stiffness_N_per_m = wall.stiffness_N_per_m;
    input.dt_s = in.dt_s;
    LookedAt looked{state, 0};
    if (input.cutting) looked = look_at(state, input, in.surface);
    return {cut(looked.next, input, point.material()), looked.triangles_seen};
}

// Divides the rest of the tick's work budget among the remaining points.
ProxyBudget share_of_rest(const ContactRecord& contact, std::uint32_t point, double budget_ns) {
    const double left_ns = std::max(budget_ns - cost_ns(contact.work), 0.0);
    return {.max_cost_ns = left_ns / (contact.point_count - point)};
}

std::uint32_t deepest_of(const ContactRecord& contact) {
    std::uint32_t deepest = 0;
    for (std::uint32_t i = 1; i < contact.point_count; ++i)
        if (contact.points[i].penetration_m > contact.points[deepest].penetration_m) deepest = i;
    return deepest;
}

}  // namespace

void touch_surface(const ProbeStep& step, const ProbeInput& input) noexcept {
    ContactRecord& contact = step.contact;
    contact.point_count = input.parameters.probe.count;
    const bool pressed = (input.sample.buttons & 1u) != 0;
    const bool painting = pressed && input.parameters.action == ToolAction::paint;
    const bool cutting = pressed && input.parameters.action == ToolAction::cut;
    std::array<std::optional<PointContact>, kMostProbePoints> points;
    Touching touching;
    const double budget = budget_ns(input.parameters.work, input.dt_s);
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        points[i].emplace(input, step, i).touch(painting, share_of_rest(contact, i, budget));
        if (!points[i]->in_contact()) continue;
        ++touching.points;
        if (contact.point_count > 1) touching.squared_arms_m2 += points[i]->squared_arm_m2();
    }
    std::array<PointForce, kMostProbePoints> forces;
    Vec3 drag_device_N(0.0);
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        PointContact& point = *points[i];
        const RenderedWall rendered_wall = rendered(point.material(), input, touching);
        if (rendered_wall.bound != StiffnessBound::none) {
            step.flags |= kTickStiffnessLimited;
            contact.stiffness_bound = rendered_wall.bound;
        }
        Vec3 bearing = point.record().proxy_object_m;
        if (i == 0) {
            const CutByPoint cut = cut_by(point, step.next.cutting, rendered_wall.wall, cutting, input);
            step.next.cutting = cut.step.next;
            contact.work.triangles_seen += cut.triangles_seen;
            if (cut.step.next.engaged) step.flags |= kTickCutting;
            drag_device_N = cut.step.drag_device_N;
            bearing = contact.cut_object_m = cut.step.bearing_object_m;
        }
        forces[i] = point.force(rendered_wall.wall, bearing);
        contact.spring_energy_J += point.spring_energy_J(rendered_wall.wall, bearing);
    }
    contact.deepest = deepest_of(contact);
    contact.wrench = sum_of({forces.data(), contact.point_count});
    contact.wrench.force_device_N += drag_device_N;
}

void follow_hand(const ProbeStep& step, const ProbeInput& input) noexcept {
    step.contact.point_count = input.parameters.probe.count;
    for (std::uint32_t i = 0; i < step.contact.point_count; ++i) PointContact(input, step, i).stay_with_hand();
    step.contact.cut_object_m = step.contact.points[0].hip_object_m;
}

}  // namespace burin::haptics
