// SPDX-License-Identifier: MIT
#include "haptics/probe_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "haptics/forces/body_push.hpp"
#include "haptics/forces/easing.hpp"
#include "haptics/forces/touch_force.hpp"
#include "haptics/point_contact.hpp"

namespace burin::haptics {
namespace {

// How long a body is followed beyond its time where a surface of any age is trusted.
constexpr double kLongestFollowed_s = 0.5;
// Of the clearance: how far the proxy may be ahead of the cutting point. More than the clearance, since the facets of
// the tool's own bed lie a little deeper than the tool did: else the tool would sink by that with each new surface.
constexpr double kSlack = 1.25;

// Of what a look may cost: its looks; the rest is for the pieces.
constexpr double kOfLooks = 0.4;

// The points that touch at once.
struct Touching {
    double shares = 0.0;           // of the points: how many they are where each renders all of its surface
    double squared_arms_m2 = 0.0;  // sum; 0 with one point
};

// How much stiffer a wall of this normal is along a drive of one way than at the handle: the square of how far the
// handle moves along the normal with it; 1 at least, since a wall is not rendered stiffer than it is.
double squared_lever(const PointContact& point, const ProbeInput& in) {
    const devices::OneWayDrive& drive = in.sample.drive;
    if (!drive.is_one()) return 1.0;
    const Vec3 normal_device = glm::conjugate(in.motion.object_from_device.orientation) * point.record().normal_object;
    const double moves = glm::dot(normal_device, drive.moves_device);
    return std::max(1.0, moves * moves);
}

// The wall as the device may render it. Points that touch at once are parallel springs whose stiffnesses add up where
// their normals agree, so each gets its share of the limit, as of the stiffness (ProbePoint::share).
RenderedWall rendered_at(const PointContact& point, double share, const ProbeInput& input, const Touching& touching) {
    const TickParameters& parameters = input.parameters;
    const TouchMaterial& material = point.material();
    WallDemand demand;
    demand.wall = {share * material.stiffness_N_per_m, share * material.damping_Ns_per_m};
    demand.coupling = parameters.coupling;
    demand.limit = parameters.limit_stiffness && share != 0.0;
    if (!demand.limit) return rendered(demand, input.device);
    demand.points = std::max(touching.shares / share, 1.0) * squared_lever(point, input);
    demand.squared_arms_m2 = touching.squared_arms_m2;
    demand.filter_lag_s = mean_lag_s(parameters.signals.force_alpha, input.dt_s);
    demand.period_s = input.dt_s;
    return rendered(demand, input.device);
}

// What one tick may spend on contact; the parts of a device share it.
double budget_of(const ProbeInput& in) { return in.turn.of(budget_ns(in.parameters.work, in.dt_s)); }

// Without what of it would draw the hand on into the material, away from where the spring draws it.
Vec3 drag_that_holds_back(const Vec3& drag_N, const Vec3& spring_m) {
    const double length2 = glm::dot(spring_m, spring_m), along = glm::dot(drag_N, spring_m);
    return length2 > 0.0 && along < 0.0 ? drag_N - along / length2 * spring_m : drag_N;
}

// Advances the cutting point with the probe's first point, and looks where a tool's shape is borne.
CuttingStep cut_by(PointContact& point, CuttingState& state, const CoupledWall& wall, bool cutting,
                   const ProbeInput& in, ContactWork& work) {
    const ToolSurface& tool = in.parameters.tool;
    CuttingInput input;
    input.hip_object_m = point.record().hip_object_m;
    input.proxy_object_m = point.record().proxy_object_m;
    input.orientation_object = in.motion.orientation_object;
    input.velocity_device_m_per_s = in.motion.velocity_device_m_per_s - in.motion.piece.at(in.sample.position_device_m);
    input.scale = in.motion.object_from_device.scale;
    input.slack_m = kSlack * in.parameters.clearance_ratio * tool.size_m;
    input.in_contact = point.in_contact();
    // What touches may find no place in the tool's own bed. The tool stays where it has cut to: it is never set into
    // material that it has not cut.
    const bool stays = cutting && state.engaged && !input.in_contact && !point.is_free() && !point.has_let_go();
    if (stays) input.proxy_object_m = state.point_object_m;
    input.cutting = cutting && (stays || input.in_contact || point.is_free());
    input.stiffness_N_per_m = wall.stiffness_N_per_m;
    input.dt_s = in.dt_s;
    if (input.cutting || (point.has_shape() && input.in_contact)) {
        const double kept_ns =
            input.cutting ? reserve_for(state, in.surface, budget_of(in), point.has_shape()).step_ns : 0.0;
        const double left_ns = std::max(budget_of(in) - cost_ns(work) - kept_ns, 0.0);
        const EngagementWork most{static_cast<std::uint32_t>(kOfLooks * left_ns / WorkCost::kLook_ns),
                                  static_cast<std::uint32_t>((1.0 - kOfLooks) * left_ns / WorkCost::kPiece_ns)};
        const LookedAt looked = look_at(state, input, tool, in.surface, most);
        state.known = looked.known;
        work.triangles_seen += looked.work.looks;
        work.pieces += looked.work.pieces;
        if (point.has_shape())
            if (const auto middle = middle_of_bearing(state.known, input, tool))
                point.bear_at(*middle, input.proxy_object_m);
    }
    const double left_ns = std::max(budget_of(in) - cost_ns(work), 0.0);
    input.most_terms = static_cast<std::uint32_t>(std::min(left_ns / WorkCost::kTerm_ns, 1e9));
    CuttingStep step = cut(state, input, tool, point.material());
    work.cutting_terms += step.terms;
    state = step.next;
    if (stays) point.stay_in_bed(step.bearing_object_m);
    return step;
}

using PointContacts = std::array<std::optional<PointContact>, kMostProbePoints>;

// Moves the proxies of all points, as far as the tick's work goes.
void touch_points(PointContacts& points, const ProbeStep& step, const ProbeInput& input, bool cutting) {
    const std::uint32_t count = step.contact.point_count;
    double budget = budget_of(input);
    if (cutting) {
        const CuttingReserve kept = reserve_for(step.next.cutting, input.surface, budget, points[0]->has_shape());
        budget -= kept.look_ns + kept.step_ns;
    }
    const auto left_ns = [&] { return std::max(budget - cost_ns(step.contact.work), 0.0); };
    if (count == 1) {
        points[0]->touch({.max_cost_ns = left_ns()});
        return;
    }
    PointQueue queue(step.next.turns, count, budget_ns(input.parameters.work, input.dt_s), left_ns());
    for (std::uint32_t n = 0; n < count; ++n) {
        const PointQueue::Turn turn = queue.next(left_ns());
        PointContact& point = *points[turn.point];
        if (turn.held_over) {
            point.wait({.max_cost_ns = turn.share_ns});
            continue;
        }
        const PointContact::Moved moved = point.touch({.max_cost_ns = turn.share_ns}, turn.needed_ns);
        // What was stopped by something else than its work, as by its number of steps, has not fallen short.
        constexpr double kSpent = 0.5;
        queue.served(turn, moved.cost_ns, moved.coarse || (moved.limited && moved.cost_ns >= kSpent * moved.most_ns));
    }
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

using WallsOfPoints = std::array<CoupledWall, kMostProbePoints>;

// The walls that the points render in this tick, and what is told of them.
WallsOfPoints eased_walls(const PointContacts& points, const ProbeStep& step, const ProbeInput& input,
                          const Touching& touching) {
    ContactRecord& contact = step.contact;
    std::array<std::optional<CoupledWall>, kMostProbePoints> asked;
    WallsOfPoints walls;
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        const double share = input.parameters.probe.points[i].share;
        const RenderedWall wall = rendered_at(*points[i], share, input, touching);
        walls[i] = wall.wall;
        if (!points[i]->in_contact()) continue;
        asked[i] = wall.wall;
        if (wall.bound == StiffnessBound::none) continue;
        step.flags |= kTickStiffnessLimited;
        contact.stiffness_bound = wall.bound;
    }
    ease_walls(step.next.walls, asked, input.dt_s);
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        if (!asked[i]) continue;
        const TouchMaterial& material = points[i]->material();
        const double share = input.parameters.probe.points[i].share;
        walls[i] = step.next.walls[i].wall();
        contact.points[i].asked = {share * material.stiffness_N_per_m, share * material.damping_Ns_per_m};
        contact.points[i].rendered = walls[i];
    }
    return walls;
}

// The edits of an object of the surface; nothing where it is not there.
std::optional<std::uint32_t> edits_of(std::uint32_t object, const geometry::LocalSurface& surface) {
    if (object == geometry::LocalSurface::kUnnumbered) return surface.tiles_edits;
    for (const geometry::TouchedMesh& mesh : surface.meshes)
        if (mesh.object == object) return mesh.edits;
    for (std::uint32_t i = 0; i < std::min(surface.models.count, geometry::LocalModels::kMost); ++i)
        if (surface.models.list[i].object == object) return 0;
    return std::nullopt;
}

// A bit for each material that can be felt.
std::uint32_t materials_felt(const TickParameters& parameters) {
    static_assert(kMostMaterials <= 32);
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < kMostMaterials; ++i) bits |= parameters.materials[i].enabled ? 1u << i : 0u;
    return bits;
}

// Notes what the points touch. Returns whether something that they touched in the last tick has been edited or taken
// away since, or they themselves have.
bool note_what_is_touched(TouchedBefore& before, const ContactRecord& contact, const ProbeInput& input) {
    const geometry::LocalSurface& surface = input.surface;
    const std::uint32_t can_be_felt = materials_felt(input.parameters);
    bool edited = (before.count != 0 && !same(before.probe, input.parameters.probe)) ||
                  (before.materials_felt != 0 && before.materials_felt != can_be_felt);
    const bool published = before.surface_sequence != surface.sequence;
    for (std::uint32_t i = 0; i < before.count; ++i) {
        const TouchedObject& touched = before.objects[i];
        if (!published || touched.object == 0) continue;
        edited = edited || edits_of(touched.object, surface) != touched.edits;
    }
    before.surface_sequence = surface.sequence;
    before.probe = input.parameters.probe;
    before.materials_felt = can_be_felt;
    before.count = 0;
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        if (contact.points[i].constraints == 0) continue;
        const std::uint32_t object = contact.points[i].object;
        before.objects[before.count++] = {object, edits_of(object, surface).value_or(0)};
    }
    return edited;
}

std::uint32_t deepest_of(const ContactRecord& contact) {
    std::uint32_t deepest = 0;
    for (std::uint32_t i = 1; i < contact.point_count; ++i)
        if (contact.points[i].penetration_m > contact.points[deepest].penetration_m) deepest = i;
    return deepest;
}

// The slope of a body's model as the device may render it, one of so many at once.
StiffnessLimit rendered_slope(const geometry::LocalModel& model, std::uint32_t models, const ProbeInput& input) {
    const double scale = input.motion.object_from_device.scale;
    const TickParameters& parameters = input.parameters;
    const CoupledWall wall =
        through(parameters.coupling, {model.stiffness_N_per_m * scale, model.damping_Ns_per_m * scale});
    if (!parameters.limit_stiffness) return {wall.stiffness_N_per_m, wall.damping_Ns_per_m, StiffnessBound::none};
    ContactDemand demand;
    demand.stiffness_N_per_m = wall.stiffness_N_per_m * models;
    demand.damping_Ns_per_m = wall.damping_Ns_per_m * models;
    demand.filter_lag_s = mean_lag_s(parameters.signals.force_alpha, input.dt_s);
    demand.period_s = input.dt_s;
    StiffnessLimit limit = limited(demand, input.device);
    limit.stiffness_N_per_m /= models;
    return limit;
}

// Adds what bodies that give push each point with. A point that touches nothing else rests on their surface.
void push_points(const ProbeStep& step, const ProbeInput& input, std::span<PointForce> forces,
                 SurfaceVelocity& surface) {
    const geometry::LocalModels& models = input.surface.models;
    const MotionRecord& motion = input.motion;
    const Similarity& map = motion.object_from_device;
    const Quat device_from_object = glm::conjugate(map.orientation);
    for (std::uint32_t i = 0; i < std::min(models.count, geometry::LocalModels::kMost); ++i) {
        const geometry::LocalModel& model = models.list[i];
        if (model.point >= forces.size() || !model.is_sensible()) continue;
        PointRecord& record = step.contact.points[model.point];
        const StiffnessLimit slope = rendered_slope(model, std::min(models.count, geometry::LocalModels::kMost), input);
        const Vec3 turning = glm::cross(motion.angular_velocity_device_rad_per_s, forces[model.point].arm_device_m);
        const Vec3 of_piece = motion.piece.at(input.sample.position_device_m + forces[model.point].arm_device_m);
        const Vec3 velocity = map.scale * (map.orientation * (motion.velocity_device_m_per_s + turning - of_piece));
        const BodyPush push =
            push_of(model, {record.hip_object_m, velocity, slope.stiffness_N_per_m / map.scale, input.now_ns});
        if (!(push.force_N > 0.0)) continue;
        if (slope.bound != StiffnessBound::none) {
            step.flags |= kTickStiffnessLimited;
            step.contact.stiffness_bound = slope.bound;
        }
        const Vec3 force_device_N = push.force_N * (device_from_object * model.normal_object);
        forces[model.point].force_device_N += force_device_N;
        record.force_device_N += force_device_N;
        step.contact.spring_energy_J += push.energy_J;
        surface.add(device_from_object * model.velocity_object_m_per_s / map.scale + of_piece, force_device_N);
        step.flags |= kTickInContact;
        if (record.constraints > 0) continue;
        record.constraints = 1;
        record.normal_object = model.normal_object;
        record.object = model.object;
        record.penetration_m = push.surface_m;
        record.proxy_object_m = record.hip_object_m + push.surface_m * model.normal_object;
    }
}

}  // namespace

void touch_surface(const ProbeStep& step, const ProbeInput& input) noexcept {
    ContactRecord& contact = step.contact;
    contact.point_count = input.parameters.probe.count;
    const bool pressed = (input.sample.buttons & 1u) != 0;
    const bool cutting = pressed && input.parameters.action == ToolAction::cut;
    const double longest_s = input.parameters.max_surface_age_s;
    const bool held_over = input.turn.held_over;
    if (held_over) step.flags |= kTickHeldOver;
    // A part that is held over takes no notice of where the bodies have gone: its next tick sweeps their whole way.
    BodiesState unnoticed;
    if (held_over) unnoticed = step.next.bodies;
    const MovingBodies bodies(held_over ? unnoticed : step.next.bodies, input.surface, input.now_ns,
                              longest_s > 0.0 ? longest_s : kLongestFollowed_s);
    PointContacts points;
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        points[i].emplace(input, step, bodies, i);
        if (held_over) points[i]->touch_last_plane();
    }
    if (held_over)
        wait(step.next.turns);
    else
        touch_points(points, step, input, cutting);
    Touching touching;
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        if (!points[i]->in_contact()) continue;
        touching.shares += input.parameters.probe.points[i].share;
        if (contact.point_count > 1 || points[i]->has_shape()) touching.squared_arms_m2 += points[i]->squared_arm_m2();
    }
    const WallsOfPoints walls = eased_walls(points, step, input, touching);
    std::array<PointForce, kMostProbePoints> forces;
    Vec3 drag_device_N(0.0);
    std::optional<Vec3> cut_torque_device_Nm;  // of the material on a tool that cuts
    SurfaceVelocity surface;
    for (std::uint32_t i = 0; i < contact.point_count; ++i) {
        PointContact& point = *points[i];
        Vec3 bearing = point.record().proxy_object_m;
        if (i == 0) {
            const CuttingStep cut = cut_by(point, step.next.cutting, walls[i], cutting, input, contact.work);
            if (cut.next.engaged) {
                step.flags |= kTickCutting;
                point.bear_on_cut(cut.bearing_object_m);
            }
            if (cut.next.engaged && point.has_shape())
                cut_torque_device_Nm =
                    glm::conjugate(input.motion.object_from_device.orientation) * cut.torque_device_Nm;
            const Quat device_from_object = glm::conjugate(input.motion.object_from_device.orientation);
            drag_device_N = drag_that_holds_back(
                cut.drag_device_N, device_from_object * (cut.bearing_object_m - point.record().hip_object_m));
            bearing = contact.cut_object_m = cut.bearing_object_m;
        }
        if (i == 0)
            contact.tool_orientation_object =
                point.has_shape() ? step.next.tool_orientation_object : input.motion.orientation_object;
        bearing = point.less_left_out(bearing);
        forces[i] = point.force(walls[i], bearing);
        surface.add(point.surface_velocity_device_m_per_s(), forces[i].force_device_N);
        contact.spring_energy_J += point.spring_energy_J(walls[i], bearing);
    }
    if (input.surface.models.count > 0) push_points(step, input, {forces.data(), contact.point_count}, surface);
    contact.edited = note_what_is_touched(step.next.touched, contact, input);
    contact.surface_velocity_device_m_per_s = surface.mean();
    contact.deepest = deepest_of(contact);
    contact.wrench = sum_of({forces.data(), contact.point_count});
    if (cut_torque_device_Nm) contact.wrench.torque_device_Nm = *cut_torque_device_Nm;
    contact.wrench.force_device_N += drag_device_N;
}

void place_proxies(ProbeState& state, const Vec3& position_object_m, std::uint64_t surface_sequence) noexcept {
    ProxyState placed;
    placed.position_object_m = placed.hip_object_m = position_object_m;
    placed.surface_sequence = surface_sequence;
    placed.placed = true;
    state.proxies.fill(placed);
    state.watches = {};
    state.contacts = {};
    state.walls = {};
    state.left_out_m = {};
    state.cutting.engaged = false;
}

bool fits_at_hand(const ProbeStep& step, const ProbeInput& input) noexcept {
    BodiesState unnoticed = step.next.bodies;
    const MovingBodies bodies(unnoticed, input.surface, input.now_ns, kLongestFollowed_s);
    for (std::uint32_t i = 0; i < input.parameters.probe.count; ++i) {
        const double left_ns = std::max(budget_of(input) - cost_ns(step.contact.work), 0.0);
        if (!PointContact(input, step, bodies, i).fits_at_hand({.max_cost_ns = left_ns})) return false;
    }
    return true;
}

void follow_hand(const ProbeStep& step, const ProbeInput& input) noexcept {
    step.contact.point_count = input.parameters.probe.count;
    step.next.bodies.count = 0;
    step.next.walls = {};
    step.next.touched.count = 0;
    const MovingBodies none;
    for (std::uint32_t i = 0; i < step.contact.point_count; ++i) PointContact(input, step, none, i).stay_with_hand();
    step.contact.cut_object_m = step.contact.points[0].hip_object_m;
    step.contact.tool_orientation_object = input.motion.orientation_object;
}

}  // namespace burin::haptics
