// SPDX-License-Identifier: MIT
#include "haptics/probe_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "haptics/contact/friction.hpp"
#include "haptics/contact/touching.hpp"
#include "haptics/forces/touch_force.hpp"

namespace burin::haptics {
namespace {

// Where a motion that nothing has announced lengthens the spring by more than this in one tick, at the device, that
// length is left out of the force at first and comes back over time (haptics/contact/moving_bodies.hpp).
constexpr double kJump_m = 0.0005;
// The length left out decays exponentially: to exp(-kComingBack) of itself within the gate's ramp for contacts.
constexpr double kComingBack = 3.0;
// The share of the spring from which on a part left out of it is told.
constexpr double kFelt = 0.01;

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
          watch_(step.next.watches[index]),
          last_(step.next.contacts[index]),
          left_out_m_(step.next.left_out_m[index]),
          record_(step.contact.points[index]) {
        const MotionRecord& motion = input.motion;
        arm_device_m_ = input.sample.orientation_device * point_.offset_device_m;
        velocity_device_m_per_s_ = motion.velocity_device_m_per_s;
        if (input.parameters.probe.count > 1)
            velocity_device_m_per_s_ += glm::cross(motion.angular_velocity_device_rad_per_s, arm_device_m_);
        record_.hip_object_m = motion.object_from_device * (input.sample.position_device_m + arm_device_m_);
        record_.proxy_object_m = record_.hip_object_m;
    }

    void stay_with_hand() {
        state_ = {record_.hip_object_m, input_.surface.sequence, false};
        watch_ = {};
        last_ = {};
        left_out_m_ = 0.0;
        record_.proxy_object_m = record_.hip_object_m;
    }

    void touch(bool painting, const ProxyBudget& budget) {
        const bool was_fitting = state_.placed && state_.unfit_ticks == 0;
        const bool published = state_.surface_sequence != input_.surface.sequence;
        if (!was_fitting) left_out_m_ = 0.0;
        // With a moving body relative to it, as friction asks; the body touched in the last tick.
        const ProxySettings settings = this->settings(painting);
        const CarriedProxy carried = carry(state_, bodies_, settings.contact_radius_m, kElsewhere_m * scale(), budget);
        const Vec3 before = carried.state.position_object_m;
        ProxyBudget left = bodies_.any() ? less(budget, carried.work) : budget;
        ContactWork watched;
        if (last_.constraints > 0 && was_fitting) watch(carried.state, watched);
        left = less(left, watched);
        const bool caught = input_.parameters.catch_drill && last_.constraints > 0;
        const ProxyResult moved =
            caught ? as_caught(carried.state)
                   : move_proxy(carried.state, record_.hip_object_m, settings, bodies_.surface(), left);
        const std::uint64_t carrier = state_.carrier;
        state_ = moved.next;
        if (bodies_.any() && moved.constraints > 0)
            state_.carrier = moved.active_triangle != kNoTriangle ? bodies_.name_of(moved.active_triangle) : carrier;
        count_work(watched, false);
        count_work(carried.work, !carried.complete);
        count_work(moved.work, moved.work_limited);
        if (moved.pushed_out) step_.flags |= kTickPushedOut;
        last_ = {};
        ContactWatch::note(watch_, moved.work_limited);
        if (ContactWatch::gives_up(watch_)) return let_go();
        if (state_.unfit_ticks > 0) return;
        record_.proxy_object_m = moved.next.position_object_m;
        const Vec3 reach = record_.proxy_object_m - input_.surface.center_object;
        if (!(std::sqrt(glm::dot(reach, reach)) + radius_m() <= input_.surface.radius_m))
            step_.flags |= kTickOutsideKnown;
        if (moved.active_triangle != kNoTriangle) material_ = input_.surface.material(moved.active_triangle);
        if (!bears(moved.constraints, moved.normal_object)) return;
        last_ = {moved.normal_object, moved.constraints};
        if (moved.sticking) step_.flags |= kTickSticking;
        record_.active_triangle = moved.active_triangle;
        if (state_.carrier != 0)
            surface_velocity_device_m_per_s_ =
                at_device(bodies_.velocity(moved.active_triangle, record_.proxy_object_m));
        if (!was_fitting || was_put_elsewhere(moved, before))
            step_.contact.jumped = true;
        else
            leave_out(unexplained_m(before, carried.unexplained_m, published));
    }

    // A part that is held over touches the plane of its last contact alone, as that moves with its body, and does not
    // look for others; in free space it waits. Its next tick goes on from where the last one has left the proxy.
    void touch_last_plane() {
        if (!state_.placed || last_.constraints == 0) return;
        ContactWatch::wait(watch_);
        if (ContactWatch::gives_up(watch_)) return let_go();
        const std::uint32_t body = bodies_.with_name(state_.carrier);
        if (state_.carrier != 0 && body == MovingBodies::kNone) return;
        const Vec3 at =
            state_.carrier != 0 ? bodies_.carried(body, state_.position_object_m) : state_.position_object_m;
        const Vec3 spring = at - record_.hip_object_m;
        const double depth = glm::dot(spring, last_.normal_object);
        if (!(depth > 0.0)) return;
        // The body's unannounced motion since this part's last full tick. It is left out of this tick's force alone;
        // the next full tick enters it into left_out_m_.
        const Vec3 unexplained = state_.carrier != 0 ? bodies_.unexplained(body, at) : Vec3(0.0);
        if (glm::length(unexplained) > kElsewhere_m * scale()) return;
        const ProxySettings settings = this->settings(false);
        const Vec3 along = depth * last_.normal_object - spring;
        const double coefficient = state_.slipping ? settings.dynamic_friction : settings.static_friction;
        record_.proxy_object_m = at + sliding_share(along, depth, coefficient) * along;
        if (!bears(last_.constraints, last_.normal_object)) return;
        if (state_.carrier != 0)
            surface_velocity_device_m_per_s_ = at_device(bodies_.velocity_of_body(state_.carrier, at));
        leave_out(0.0);
        const double added_m =
            glm::dot(unexplained, record_.proxy_object_m - record_.hip_object_m) / record_.penetration_m;
        if (added_m > kJump_m * scale()) left_out_now_m_ = added_m;
    }

    [[nodiscard]] bool in_contact() const { return record_.constraints > 0; }
    // The material touched in the last tick until this one has touched: at a border friction changes a tick late.
    [[nodiscard]] const TouchMaterial& material() const {
        return input_.parameters.materials[std::min<std::uint32_t>(material_, kMostMaterials - 1)];
    }
    [[nodiscard]] double radius_m() const { return point_.radius_m * (1.0 - input_.parameters.clearance_ratio); }
    [[nodiscard]] const PointRecord& record() const { return record_; }
    [[nodiscard]] double squared_arm_m2() const { return glm::dot(arm_device_m_, arm_device_m_); }

    // Returns the point from which the spring pulls: the bearing point, moved towards the HIP by the length left out.
    [[nodiscard]] Vec3 less_left_out(const Vec3& bearing_object_m) const {
        const double left_out_m = std::min(left_out_m_ + left_out_now_m_, record_.penetration_m);
        const double share = in_contact() ? 1.0 - left_out_m / record_.penetration_m : 1.0;
        return record_.hip_object_m + share * (bearing_object_m - record_.hip_object_m);
    }

    // The force of this point on the hand.
    [[nodiscard]] PointForce force(const CoupledWall& wall, const Vec3& bearing_object_m) {
        if (in_contact()) {
            const Similarity& map = input_.motion.object_from_device;
            record_.force_device_N =
                ContactWatch::share(watch_) *
                touch_force_device({record_.hip_object_m, bearing_object_m, record_.normal_object,
                                    velocity_device_m_per_s_ - surface_velocity_device_m_per_s_, map.orientation,
                                    map.scale, wall.stiffness_N_per_m, wall.damping_Ns_per_m});
        }
        return {arm_device_m_, record_.force_device_N};
    }

    // Of the surface touched; zero where it rests.
    [[nodiscard]] const Vec3& surface_velocity_device_m_per_s() const { return surface_velocity_device_m_per_s_; }

    // Energy stored in the wall's spring at this point.
    [[nodiscard]] double spring_energy_J(const CoupledWall& wall, const Vec3& bearing_object_m) const {
        if (!in_contact()) return 0.0;
        const Vec3 spring_device_m = (bearing_object_m - record_.hip_object_m) / input_.motion.object_from_device.scale;
        return ContactWatch::share(watch_) * 0.5 * wall.stiffness_N_per_m * glm::dot(spring_device_m, spring_device_m);
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

    // Tells whether the ball was pushed out of material by more than a jump.
    [[nodiscard]] bool was_put_elsewhere(const ProxyResult& moved, const Vec3& before) const {
        return moved.pushed_out && glm::length(record_.proxy_object_m - before) > kJump_m * scale();
    }

    // By how much something that no motion explains has lengthened the spring; negative: shortened.
    [[nodiscard]] double unexplained_m(const Vec3& before, const Vec3& of_bodies_m, bool published) const {
        const Vec3 spring = record_.proxy_object_m - record_.hip_object_m;
        // A published surface may push the ball while its centre stays outside.
        const double pushed_m =
            published ? record_.penetration_m - glm::length(before - record_.hip_object_m) : -HUGE_VAL;
        const double moved_m = glm::dot(of_bodies_m, spring) / record_.penetration_m;
        return pushed_m > kJump_m * scale() ? std::max(pushed_m, moved_m) : moved_m;
    }

    // Leaves what has come unexplained out of the force, and lets what was left out come back. What has gone
    // unexplained makes up for what has come before.
    void leave_out(double unexplained_m) {
        left_out_m_ *= std::exp(-kComingBack * input_.dt_s / std::max(input_.parameters.limits.contact_ramp_s, 1e-6));
        if (unexplained_m > kJump_m * scale() || unexplained_m < 0.0) left_out_m_ += unexplained_m;
        left_out_m_ = std::clamp(left_out_m_, 0.0, record_.penetration_m);
        if (left_out_m_ > kFelt * record_.penetration_m) step_.flags |= kTickRamping;
    }

    // Notes a contact at the proxy, if there is one.
    bool bears(std::uint32_t constraints, const Vec3& normal_object) {
        const double depth = glm::length(record_.proxy_object_m - record_.hip_object_m);
        if (constraints == 0 || !(depth > 0.0) || !material().enabled) return false;
        step_.flags |= kTickInContact;
        record_.constraints = constraints;
        record_.penetration_m = depth;
        record_.normal_object = normal_object;
        return true;
    }

    // The drill's result.
    [[nodiscard]] ProxyResult as_caught(const ProxyState& state) const {
        ProxyResult result;
        result.next = state;
        result.next.hip_object_m = record_.hip_object_m;
        const Vec3 spring = state.position_object_m - record_.hip_object_m;
        result.normal_object = spring / std::max(glm::length(spring), 1e-12);
        result.constraints = last_.constraints;
        result.work_limited = true;
        return result;
    }

    void let_go() {
        step_.flags |= kTickLetGo;
        stay_with_hand();
    }

    // Has the watch look at the contact of the last tick, taken along with the body that it is with.
    void watch(const ProxyState& contact, ContactWork& work) {
        const Vec3& origin = input_.surface.origin_object;
        const double felt = felt_radius_m(radius_m(), bodies_.surface().mean_edge_m());
        ContactWatch::look(watch_, {contact.position_object_m - origin, contact.hip_object_m - origin, felt},
                           bodies_.surface(), work);
        if (watch_.doubtful_looks > 0 || watch_.faded_ticks > 0) step_.flags |= kTickDoubted;
    }

    static ProxyBudget less(ProxyBudget budget, const ContactWork& work) {
        budget.max_cost_ns -= cost_ns(work) - WorkCost::kTick_ns;
        return budget;
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
    WatchState& watch_;
    LastContact& last_;
    double& left_out_m_;
    double left_out_now_m_ = 0.0;  // in this tick alone
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

}  // namespace

void touch_surface(const ProbeStep& step, const ProbeInput& input) noexcept {
    ContactRecord& contact = step.contact;
    contact.point_count = input.parameters.probe.count;
    const bool pressed = (input.sample.buttons & 1u) != 0;
    const bool painting = pressed && input.parameters.action == ToolAction::paint;
    const bool cutting = pressed && input.parameters.action == ToolAction::cut;
    const double longest_s = input.parameters.max_surface_age_s;
    const bool held_over = input.turn.held_over;
    if (held_over) step.flags |= kTickHeldOver;
    // A part that is held over takes no notice of where the bodies have gone: its next tick sweeps their whole way.
    BodiesState unnoticed;
    if (held_over) unnoticed = step.next.bodies;
    const MovingBodies bodies(held_over ? unnoticed : step.next.bodies, input.surface, input.now_ns,
                              longest_s > 0.0 ? longest_s : kLongestFollowed_s);
    std::array<std::optional<PointContact>, kMostProbePoints> points;
    Touching touching;
    const double budget = input.turn.of(budget_ns(input.parameters.work, input.dt_s));
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        points[i].emplace(input, step, bodies, i);
        if (held_over)
            points[i]->touch_last_plane();
        else
            points[i]->touch(painting, share_of_rest(contact, i, budget));
        if (!points[i]->in_contact()) continue;
        ++touching.points;
        if (contact.point_count > 1) touching.squared_arms_m2 += points[i]->squared_arm_m2();
    }
    std::array<PointForce, kMostProbePoints> forces;
    Vec3 drag_device_N(0.0);
    SurfaceVelocity surface;
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
        bearing = point.less_left_out(bearing);
        forces[i] = point.force(rendered_wall.wall, bearing);
        surface.add(point.surface_velocity_device_m_per_s(), forces[i].force_device_N);
        contact.spring_energy_J += point.spring_energy_J(rendered_wall.wall, bearing);
    }
    contact.surface_velocity_device_m_per_s = surface.mean();
    contact.deepest = deepest_of(contact);
    contact.wrench = sum_of({forces.data(), contact.point_count});
    contact.wrench.force_device_N += drag_device_N;
}

void follow_hand(const ProbeStep& step, const ProbeInput& input) noexcept {
    step.contact.point_count = input.parameters.probe.count;
    step.next.bodies.count = 0;
    const MovingBodies none;
    for (std::uint32_t i = 0; i < step.contact.point_count; ++i) PointContact(input, step, none, i).stay_with_hand();
    step.contact.cut_object_m = step.contact.points[0].hip_object_m;
}

}  // namespace burin::haptics
