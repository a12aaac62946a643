// SPDX-License-Identifier: MIT
#include "haptics/probe_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "haptics/contact/half_spaces.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::haptics {
namespace {

// A contact that is pushed farther than this in one tick, at the device, by what no published motion explains, counts
// as a new contact: its force fades in (haptics/contact/moving_bodies.hpp).
constexpr double kJump_m = 0.0005;

// How long a body is followed beyond its time where a surface of any age is trusted.
constexpr double kLongestFollowed_s = 0.5;

// Contact of one point of the probe: the motion of its proxy and the work it took.
class PointContact {
public:
    // Records into `step`, which must outlive the object.
    PointContact(const ProbeInput& input, const ProbeStep& step, const MovingBodies& bodies, std::uint32_t index)
        : input_(input),
          step_(step),
          bodies_(bodies),
          point_(input.parameters.probe.points[index]),
          state_(step.next.proxies[index]),
          material_(step.next.materials[index]),
          record_(step.contact.points[index]) {
        const MotionRecord& motion = input.motion;
        const double per_m = input.parameters.probe.rigid_tool ? 1.0 / motion.object_from_device.scale : 1.0;
        arm_device_m_ = input.sample.orientation_device * (per_m * point_.offset_device_m);
        velocity_device_m_per_s_ = motion.velocity_device_m_per_s;
        if (input.parameters.probe.count > 1)
            velocity_device_m_per_s_ += glm::cross(motion.angular_velocity_device_rad_per_s, arm_device_m_);
        record_.hip_object_m = motion.object_from_device * (input.sample.position_device_m + arm_device_m_);
        record_.proxy_object_m = record_.hip_object_m;
    }

    void stay_with_hand() { state_ = {record_.hip_object_m, input_.surface.sequence, false}; }

    void touch(bool painting, const ProxyBudget& budget) {
        const bool was_placed = state_.placed;
        const bool published = state_.surface_sequence != input_.surface.sequence;
        // With a moving body relative to it, as friction asks; the body touched in the last tick.
        const ProxySettings settings = this->settings(painting);
        const CarriedProxy carried = carry(state_, bodies_, settings.contact_radius_m, kElsewhere_m * scale(), budget);
        const Vec3 before = carried.state.position_object_m;
        ProxyBudget left = budget;
        if (bodies_.any()) left.max_cost_ns -= cost_ns(carried.work) - WorkCost::kTick_ns;
        const ProxyResult moved = move_proxy(carried.state, record_.hip_object_m, settings, bodies_.surface(), left);
        const std::uint64_t carrier = state_.carrier;
        state_ = moved.next;
        if (bodies_.any() && moved.constraints > 0)
            state_.carrier = moved.active_triangle != kNoTriangle ? bodies_.name_of(moved.active_triangle) : carrier;
        count_work(carried.work, !carried.complete);
        count_work(moved.work, moved.work_limited);
        if (moved.pushed_out) step_.flags |= kTickPushedOut;
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
        if (state_.carrier != 0)
            surface_velocity_device_m_per_s_ =
                at_device(bodies_.velocity(moved.active_triangle, record_.proxy_object_m));
        if (!was_placed || has_jumped(moved, before, carried.unexplained_m, published)) step_.contact.jumped = true;
    }

    [[nodiscard]] bool in_contact() const { return record_.constraints > 0; }
    // The material touched in the last tick until this one has touched: at a border friction changes a tick late.
    [[nodiscard]] const TouchMaterial& material() const {
        return input_.parameters.materials[std::min<std::uint32_t>(material_, kMostMaterials - 1)];
    }
    [[nodiscard]] double radius_m() const { return point_.radius_m * (1.0 - input_.parameters.clearance_ratio); }
    [[nodiscard]] const PointRecord& record() const { return record_; }
    [[nodiscard]] double squared_arm_m2() const { return glm::dot(arm_device_m_, arm_device_m_); }
    [[nodiscard]] const Vec3& velocity_device_m_per_s() const { return velocity_device_m_per_s_; }

    // Of the surface touched; zero where it rests.
    [[nodiscard]] const Vec3& surface_velocity_device_m_per_s() const { return surface_velocity_device_m_per_s_; }

    // Records what this point bears of a rigid tool's force.
    [[nodiscard]] PointForce bears(const Vec3& force_device_N) const {
        record_.force_device_N = force_device_N;
        return {arm_device_m_, force_device_N};
    }

private:
    [[nodiscard]] ProxySettings settings(bool painting) const {
        ProxySettings s;
        s.contact_radius_m = radius_m();
        s.shading = input_.parameters.shading;
        if (painting) return s;
        Vec3 slip = velocity_device_m_per_s_;
        if (state_.carrier != 0) slip -= at_device(bodies_.velocity_of_body(state_.carrier, state_.position_object_m));
        const double speed = std::sqrt(glm::dot(slip, slip));
        const FrictionCone cone = friction_at(material(), speed);
        s.static_friction = cone.static_friction;
        s.dynamic_friction = cone.dynamic_friction;
        return s;
    }

    // Whether the contact has been pushed by something that no motion explains.
    [[nodiscard]] bool has_jumped(const ProxyResult& moved, const Vec3& before, const Vec3& unexplained_m,
                                  bool published) const {
        const double jump_m = kJump_m * scale();
        const Vec3 jump = record_.proxy_object_m - before, spring = record_.proxy_object_m - record_.hip_object_m;
        if (moved.pushed_out && glm::dot(jump, jump) > jump_m * jump_m) return true;
        // A published surface may push the ball while its centre stays outside.
        const double spring_m = glm::length(spring);
        if (published && spring_m - glm::length(before - record_.hip_object_m) > jump_m) return true;
        return glm::dot(unexplained_m, spring) > jump_m * spring_m;
    }

    void count_work(const ContactWork& work, bool limited) {
        step_.contact.work += work;
        if (limited) step_.flags |= kTickWorkLimited;
    }

    [[nodiscard]] double scale() const { return input_.motion.object_from_device.scale; }
    [[nodiscard]] Vec3 at_device(const Vec3& velocity_object_m_per_s) const {
        return glm::conjugate(input_.motion.object_from_device.orientation) * velocity_object_m_per_s / scale();
    }

    const ProbeInput& input_;
    const ProbeStep& step_;
    const MovingBodies& bodies_;
    const ProbePoint& point_;
    ProxyState& state_;
    std::uint8_t& material_;
    PointRecord& record_;
    Vec3 arm_device_m_{0.0}, velocity_device_m_per_s_{0.0}, surface_velocity_device_m_per_s_{0.0};
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

// What holds the tool off the hand: one point of the probe, or all points of a rigid tool together.
struct Bearing {
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};
    Vec3 normal_object{0.0};
    bool in_contact = false;
    std::uint32_t leading = 0;                    // the point whose material it is
    std::array<Vec3, kMostProbePoints> shares{};  // of the way from the HIP to the proxy, borne by each point
};

Bearing of_point(const PointRecord& point) {
    return {point.hip_object_m, point.proxy_object_m, point.normal_object, point.constraints > 0, 0, {}};
}

// The nearest place at which a rigid tool is as far out as each of its points has to be. Each point asks for its own
// way from HIP to proxy, friction included.
Bearing of_rigid_tool(const ContactRecord& contact, const Vec3& hip_object_m) {
    Bearing bearing{hip_object_m, hip_object_m, Vec3(0.0), false, contact.deepest, {}};
    std::array<HalfSpace, kMostProbePoints> asked;
    std::array<std::uint32_t, kMostProbePoints> by{};
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        const PointRecord& point = contact.points[i];
        if (point.constraints == 0) continue;
        asked[count] = {(point.proxy_object_m - point.hip_object_m) / point.penetration_m, point.penetration_m};
        by[count++] = i;
    }
    if (count == 0) return bearing;
    bearing.in_contact = true;
    const PointRecord& deepest = contact.points[contact.deepest];
    Vec3 out = deepest.proxy_object_m - deepest.hip_object_m;
    const NearestInside nearest =
        nearest_inside(std::span(asked).first(count), Vec3(0.0), 1e-6 * deepest.penetration_m);
    if (nearest.found) {
        out = nearest.point;
        for (std::uint32_t k = 0; k < nearest.bearing_count; ++k)
            bearing.shares[by[nearest.bearing[k]]] = nearest.weights[k] * asked[nearest.bearing[k]].normal;
    } else {
        bearing.shares[contact.deepest] = out;
    }
    bearing.proxy_object_m += out;
    bearing.normal_object = out / std::sqrt(glm::dot(out, out));
    return bearing;
}

// What one tick may spend on contact; the parts of a device share it.
double budget_of(const ProbeInput& in) { return in.turn.of(budget_ns(in.parameters.work, in.dt_s)); }

// Advances the cutting point of a tool that a bearing holds.
CuttingStep cut_by(const Bearing& bearing, CuttingState& state, const TouchMaterial& material, const CoupledWall& wall,
                   bool cutting, const ProbeInput& in, ContactWork& work) {
    const ToolSurface& tool = in.parameters.tool;
    CuttingInput input;
    input.hip_object_m = bearing.hip_object_m;
    input.proxy_object_m = bearing.proxy_object_m;
    input.orientation_object = in.motion.orientation_object;
    input.velocity_device_m_per_s = in.motion.velocity_device_m_per_s;
    input.scale = in.motion.object_from_device.scale;
    input.slack_m = in.parameters.clearance_ratio * tool.size_m;
    input.cutting = cutting && bearing.in_contact;
    input.stiffness_N_per_m = wall.stiffness_N_per_m;
    input.dt_s = in.dt_s;
    if (input.cutting) {
        const double left_ns = std::max(budget_of(in) - cost_ns(work), 0.0);
        const EngagementWork most{static_cast<std::uint32_t>(0.25 * left_ns / WorkCost::kLook_ns),
                                  static_cast<std::uint32_t>(0.25 * left_ns / WorkCost::kPiece_ns)};
        const LookedAt looked = look_at(state, input, tool, in.surface, most);
        state.known = looked.known;
        work.triangles_seen += looked.work.looks;
        work.pieces += looked.work.pieces;
    }
    CuttingStep step = cut(state, input, tool, material);
    work.cutting_terms += step.terms;
    state = step.next;
    return step;
}

// Divides the rest of the tick's work budget among the remaining points.
ProxyBudget share_of_rest(const ContactRecord& contact, std::uint32_t point, double budget_ns) {
    const double left_ns = std::max(budget_ns - cost_ns(contact.work), 0.0);
    return {.max_cost_ns = left_ns / (contact.point_count - point)};
}

// The mean velocity of the surfaces touched, weighted by the forces: exact for one point, and for several whose forces
// are parallel.
class SurfaceVelocity {
public:
    void add(const Vec3& velocity_m_per_s, const Vec3& force_N) {
        const double weight = glm::length(force_N);
        sum_ += weight * velocity_m_per_s;
        weights_ += weight;
    }
    [[nodiscard]] Vec3 mean() const { return weights_ > 0.0 ? sum_ / weights_ : Vec3(0.0); }

private:
    Vec3 sum_{0.0};
    double weights_ = 0.0;
};

std::uint32_t deepest_of(const ContactRecord& contact) {
    std::uint32_t deepest = 0;
    for (std::uint32_t i = 1; i < contact.point_count; ++i)
        if (contact.points[i].penetration_m > contact.points[deepest].penetration_m) deepest = i;
    return deepest;
}

// The points of a probe in one tick.
using Points = std::span<std::optional<PointContact>>;

CoupledWall wall_at(const PointContact& point, const Touching& touching, const ProbeStep& step,
                    const ProbeInput& input) {
    const RenderedWall wall = rendered(point.material(), input, touching);
    if (wall.bound != StiffnessBound::none) {
        step.flags |= kTickStiffnessLimited;
        step.contact.stiffness_bound = wall.bound;
    }
    return wall.wall;
}

PointForce spring_between(const Bearing& bearing, const Vec3& end_object_m, const PointContact& point,
                          const CoupledWall& wall, const ProbeInput& input) {
    const Similarity& map = input.motion.object_from_device;
    if (!bearing.in_contact) return point.bears(Vec3(0.0));
    return point.bears(touch_force_device({bearing.hip_object_m, end_object_m, bearing.normal_object,
                                           point.velocity_device_m_per_s() - point.surface_velocity_device_m_per_s(),
                                           map.orientation, map.scale, wall.stiffness_N_per_m, wall.damping_Ns_per_m}));
}

double spring_energy_J(const Bearing& bearing, const Vec3& end_object_m, const CoupledWall& wall,
                       const ProbeInput& input) {
    if (!bearing.in_contact) return 0.0;
    const Vec3 spring_device_m = (end_object_m - bearing.hip_object_m) / input.motion.object_from_device.scale;
    return 0.5 * wall.stiffness_N_per_m * glm::dot(spring_device_m, spring_device_m);
}

// The points bear by themselves, and the hand feels the sum; the first one cuts.
void feel_points(const ProbeStep& step, const ProbeInput& input, Points points, bool cutting) {
    ContactRecord& contact = step.contact;
    Touching touching;
    for (const auto& point : points) {
        if (!point->in_contact()) continue;
        ++touching.points;
        if (points.size() > 1) touching.squared_arms_m2 += point->squared_arm_m2();
    }
    std::array<PointForce, kMostProbePoints> forces;
    Vec3 drag_device_N(0.0);
    SurfaceVelocity surface;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const PointContact& point = *points[i];
        const CoupledWall wall = wall_at(point, touching, step, input);
        const Bearing bearing = of_point(point.record());
        Vec3 end = bearing.proxy_object_m;
        if (i == 0) {
            const CuttingStep cut =
                cut_by(bearing, step.next.cutting, point.material(), wall, cutting, input, contact.work);
            if (cut.next.engaged) step.flags |= kTickCutting;
            drag_device_N = cut.drag_device_N;
            end = contact.cut_object_m = cut.bearing_object_m;
        }
        forces[i] = spring_between(bearing, end, point, wall, input);
        surface.add(point.surface_velocity_device_m_per_s(), forces[i].force_device_N);
        contact.spring_energy_J += spring_energy_J(bearing, end, wall, input);
    }
    contact.surface_velocity_device_m_per_s = surface.mean();
    contact.wrench = sum_of({forces.data(), points.size()});
    contact.wrench.force_device_N += drag_device_N;
}

void record_of(ContactRecord& contact, const Bearing& bearing) {
    const Vec3 spring = bearing.proxy_object_m - bearing.hip_object_m;
    const PointRecord& leading = contact.points[bearing.leading];
    contact.tool = {bearing.hip_object_m,
                    bearing.proxy_object_m,
                    bearing.normal_object,
                    Vec3(0.0),
                    std::sqrt(glm::dot(spring, spring)),
                    leading.active_triangle,
                    leading.constraints};
}

// The points are one body, held off the hand by one spring; its torque is that of what each point bears, or while it
// cuts that of the material.
void feel_rigid_tool(const ProbeStep& step, const ProbeInput& input, Points points, bool cutting) {
    ContactRecord& contact = step.contact;
    const Similarity& map = input.motion.object_from_device;
    const Bearing bearing = of_rigid_tool(contact, map * input.sample.position_device_m);
    const PointContact& leading = *points[bearing.leading];
    Touching touching{1, 0.0};
    for (const auto& point : points)
        touching.squared_arms_m2 = std::max(touching.squared_arms_m2, point->squared_arm_m2());
    const CoupledWall wall = wall_at(leading, touching, step, input);
    const CuttingStep cut = cut_by(bearing, step.next.cutting, leading.material(), wall, cutting, input, contact.work);
    record_of(contact, bearing);
    contact.cut_object_m = cut.bearing_object_m;
    contact.spring_energy_J = spring_energy_J(bearing, cut.bearing_object_m, wall, input);
    if (!bearing.in_contact) return;
    contact.surface_velocity_device_m_per_s = leading.surface_velocity_device_m_per_s();
    contact.wrench.force_device_N = contact.tool.force_device_N =
        touch_force_device({bearing.hip_object_m, cut.bearing_object_m, bearing.normal_object,
                            input.motion.velocity_device_m_per_s - leading.surface_velocity_device_m_per_s(),
                            map.orientation, map.scale, wall.stiffness_N_per_m, wall.damping_Ns_per_m}) +
        cut.drag_device_N;
    if (cut.next.engaged) {
        step.flags |= kTickCutting;
        contact.wrench.torque_device_Nm = glm::conjugate(map.orientation) * cut.torque_device_Nm;
        return;
    }
    const Vec3 out = bearing.proxy_object_m - bearing.hip_object_m;
    const double per_m =
        std::sqrt(glm::dot(contact.wrench.force_device_N, contact.wrench.force_device_N) / glm::dot(out, out));
    std::array<PointForce, kMostProbePoints> forces;
    for (std::size_t i = 0; i < points.size(); ++i)
        forces[i] = points[i]->bears(per_m * (glm::conjugate(map.orientation) * bearing.shares[i]));
    contact.wrench.torque_device_Nm = sum_of({forces.data(), points.size()}).torque_device_Nm;
}

}  // namespace

void touch_surface(const ProbeStep& step, const ProbeInput& input) noexcept {
    ContactRecord& contact = step.contact;
    const TickParameters& parameters = input.parameters;
    contact.point_count = parameters.probe.count;
    contact.rigid_tool = parameters.probe.rigid_tool;
    const bool pressed = (input.sample.buttons & 1u) != 0;
    const bool painting = pressed && parameters.action == ToolAction::paint;
    const bool cutting = pressed && parameters.action == ToolAction::cut;
    const double longest_s = parameters.max_surface_age_s;
    const MovingBodies bodies(step.next.bodies, input.surface, input.now_ns,
                              longest_s > 0.0 ? longest_s : kLongestFollowed_s);
    std::array<std::optional<PointContact>, kMostProbePoints> points;
    const double budget = budget_of(input);
    for (std::uint32_t i = 0; i < contact.point_count; ++i)
        points[i].emplace(input, step, bodies, i).touch(painting, share_of_rest(contact, i, budget));
    contact.deepest = deepest_of(contact);
    const auto feel = parameters.probe.rigid_tool ? feel_rigid_tool : feel_points;
    feel(step, input, std::span(points).first(contact.point_count), cutting);
}

void follow_hand(const ProbeStep& step, const ProbeInput& input) noexcept {
    step.contact.point_count = input.parameters.probe.count;
    step.next.bodies.count = 0;
    const MovingBodies none;
    for (std::uint32_t i = 0; i < step.contact.point_count; ++i) PointContact(input, step, none, i).stay_with_hand();
    step.contact.rigid_tool = input.parameters.probe.rigid_tool;
    if (step.contact.rigid_tool)
        step.contact.tool.hip_object_m = step.contact.tool.proxy_object_m =
            input.motion.object_from_device * input.sample.position_device_m;
    step.contact.cut_object_m =
        step.contact.rigid_tool ? step.contact.tool.hip_object_m : step.contact.points[0].hip_object_m;
}

}  // namespace burin::haptics
