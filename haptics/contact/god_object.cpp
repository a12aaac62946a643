// SPDX-License-Identifier: MIT
#include "haptics/contact/god_object.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "haptics/contact/friction.hpp"
#include "haptics/contact/setting.hpp"
#include "haptics/contact/shading.hpp"
#include "haptics/contact/touching.hpp"

namespace burin::haptics {
namespace {

// Fractions of the ball's radius; kTouch and kTie are in touching.hpp.
constexpr double kPlane = 1e-9;  // bound on the rounding of plane offsets, far below anything felt
// The proxy is at rest when it has less to go than this fraction of the radius, or of a twentieth of an edge if that is
// more, or when the HIP is off the normal by less than this angle, a tenth of what a hand may notice.
constexpr double kStill = 1e-5, kStillAngle = 1e-4;

// A step that brings the ball nearer to the HIP by less than this part of its length spends leeway; of what is left,
// this share is kept for the next tick.
constexpr double kLeastGain = 1e-3, kKeptLeeway = 0.9;

// Greatest gap, as a fraction of the radius, at which a plane bears the ball with friction.
constexpr double kBears = 1e-4;

// Depth, as a fraction of the radius, beyond which a plane has sunk into the ball.
constexpr double kSunk = 5e-3;

// Where the ball touches points, and one is nearer to its centre than this fraction of the radius, the triangles
// between them decide on inside or outside.
constexpr double kAmongPoints = 0.9;

// Range of the vote on inside or outside, as a multiple of the nearest triangle's distance; one mean edge is added.
constexpr double kVote = 1.5;

// Pushing the ball out of the thousandth of R that edges may sink in can alternate between facets. After this many
// steps the ball is only kept from going deeper, so that each step brings it nearer to the HIP and the steps come to an
// end.
constexpr std::uint32_t kPushingSteps = 3;
// Shading converges in two or three steps. Where it does not, as in a corner of the smooth surface, the ball stays
// where this many steps took it.
constexpr std::uint32_t kShadingSteps = 10;

bool rubs(const ProxySettings& settings) { return settings.static_friction > 0.0 || settings.dynamic_friction > 0.0; }

Vec3 unit_or_zero(const Vec3& v) {
    const double length2 = glm::dot(v, v);
    return length2 > 0.0 ? v / std::sqrt(length2) : Vec3(0.0);
}

// The next position of the ball, and the planes that bear it there.
struct Goal {
    bool found = false;
    Vec3 step{0.0};     // from the centre
    Vec3 normal{0.0};   // unit, of the contact; zero in free space
    double left = 0.0;  // distance left to the position at which the ball is at rest
    double enough = 0.0;
    bool in_contact = false;
    bool is_shaded = false;
    bool is_hip = false;  // no known obstacle lies between the ball and the HIP
};

// The proxy's motion in one tick. Positions are relative to the surface's origin.
class Mover {
public:
    Mover(const ProxyState& state, const Vec3& hip_object_m, const ProxySettings& settings,
          const geometry::PosedSurface& surface, const ProxyBudget& budget)
        : settings_(settings),
          surface_(surface),
          budget_(budget),
          edge_(surface.mean_edge_m()),
          radius_(felt_radius_m(settings.contact_radius_m, edge_)),
          still_(kStill * std::max(radius_, 0.05 * edge_)),
          hip_(hip_object_m - surface.origin_object()),
          search_(surface, radius_, budget, result_.work),
          facets_(surface),
          // With friction a first step must not be longer than it is known to be: what slides too far stays there.
          step_share_(state.placed && !rubs(settings) ? state.step_share : 1.0) {
        result_.next = {.position_object_m = hip_object_m,
                        .surface_sequence = surface.surface().sequence,
                        .placed = true,
                        .hip_object_m = hip_object_m};
        leeway_ = state.placed ? std::min(kKeptLeeway * state.leeway_m + glm::length(hip_object_m - state.hip_object_m),
                                          radius_ + edge_)
                               : 0.0;
        center_ = state.placed ? state.position_object_m - surface.origin_object() : hip_;
        search_.begin_with_stride(state.stride);
        slips_ = state.slipping;
        touched_before_ = state.placed && state.touching;
        unfit_ticks_ = state.placed ? state.unfit_ticks : 0;
        was_set_ = !state.placed || unfit_ticks_ > 0;
        if (unfit_ticks_ >= kMostUnfitTicks) center_ = hip_;
    }

    ProxyResult move(const ProxyState& state) {
        began_ = center_;
        if (unfit_ticks_ >= kMostUnfitTicks) return wait_outside();
        if (!begin(state)) return limited();
        began_ = center_;
        for (;;) {
            if (!search_.has_work_for(WorkCost::kStep_ns)) return limited();
            ++result_.work.steps;
            Goal goal = aim();
            if (!goal.found) goal = creep();
            if (!goal.found) return limited();
            if (arrived(goal)) return goal.in_contact ? at_rest(goal) : free();
            const Going going = go(goal);
            if (going == Going::arrived_free) return free();
            if (going == Going::out_of_work || result_.work.steps >= budget_.max_steps || !touch()) return limited();
        }
    }

private:
    // Runs the broad phase along the ball's expected motion (that of the last tick, or towards the HIP), and puts the
    // ball outside if it is inside material.
    bool begin(const ProxyState& state) {
        const Vec3 pull = hip_ - center_;
        Vec3 onward = state.touching ? state.motion_object_m : pull;
        if (glm::dot(onward, onward) > 4.0 * glm::dot(pull, pull) + radius_ * radius_)
            // The hand has turned back or stopped: the last motion is no guess for this one.
            onward = Vec3(0.0);
        if (!search_.broad_phase({center_, center_ + onward}) || !touch()) return false;
        const bool unsure = !state.placed || state.surface_sequence != surface_.surface().sequence;
        const bool among_points = search_.candidates().points() > 0 && nearest_.distance < kAmongPoints * radius_;
        if ((unsure && !(nearest_.distance < HUGE_VAL)) || among_points)
            nearest_ = search_.nearest(center_, known_around(center_, surface_));
        if (!inside_material(nearest_, center_, surface_)) return true;
        // A facet folded over may be nearest and show its back to a ball that is outside.
        if (!search_.sees_backs(center_, kVote * nearest_.distance + edge_)) return true;
        center_ = put_outside(nearest_, center_, radius_);
        result_.pushed_out = was_set_ = true;
        return search_.broad_phase({center_, center_}) && touch();
    }

    // A ball that could not be pushed out follows the hand without contact until it fits where the hand is.
    ProxyResult wait_outside() {
        if (!search_.broad_phase({center_, center_}) || !touch()) return unfit();
        if (!(nearest_.distance < HUGE_VAL)) nearest_ = search_.nearest(center_, known_around(center_, surface_));
        const bool inside = inside_material(nearest_, center_, surface_) &&
                            search_.sees_backs(center_, kVote * nearest_.distance + edge_);
        return inside || nearest_.distance < (1.0 - kUnfit) * radius_ ? unfit() : result_;
    }

    bool touch() {
        const auto touching = search_.touching(center_, touches_);
        nearest_ = touching.nearest;
        return looked_ = touching.complete;
    }

    Goal aim() {
        const bool pushing = result_.work.steps <= kPushingSteps;
        if (!pushing) only_no_deeper();
        if (rubs(settings_) && touches_.count > 0 && !(pushing && sunk())) return held_goal();
        const Vec3 pull = hip_ - center_;
        NearestInside plain = nearest_in(touches_.span(), pull);
        if (!plain.found && pushing) {  // there is no free space to be pushed out into
            only_no_deeper();
            plain = nearest_in(touches_.span(), pull);
        }
        Goal goal = goal_of(plain, pull);
        if (!goal.found || !goal.in_contact) return goal;
        Goal smooth = goal;
        if (settings_.shading) shade(smooth, plain, pull, false);
        if (!smooth.is_shaded) return farther(goal, pull);
        onto_surface(smooth);
        return smooth.left <= smooth.enough || spend_leeway(smooth, goal, pull) ? smooth : goal;
    }

    // Shading may lead the ball away from the HIP. On a rough surface it can then slide back for ever, round and round,
    // while the hand holds still. So it spends leeway, which only the hand's motion gives, on each step that does not
    // bring the ball nearer to the HIP by a small part of its length. When none is left the ball goes where it goes
    // without shading, which always is nearer to the HIP: its way comes to an end. Compared with the goal without
    // shading, for a ball that must be pushed out of the surface goes away from the HIP in any case.
    [[nodiscard]] bool spend_leeway(const Goal& smooth, const Goal& plain, const Vec3& pull) {
        const double before = std::max(glm::length(pull), glm::length(pull - plain.step));
        const double cost = glm::length(pull - smooth.step) - before + kLeastGain * glm::length(smooth.step);
        if (cost <= 0.0) return true;
        if (cost > leeway_) return false;
        leeway_ -= cost;
        return true;
    }

    // Around an edge or a corner the ball goes on a circle, and a tangent's nearest point leaves it short of its rest,
    // each step by the same part. So it goes farther, by what the last steps have shown, as long as it has leeway.
    [[nodiscard]] Goal farther(const Goal& goal, const Vec3& pull) {
        Goal far = goal;
        const double share = step_share_.of(center_, goal.step);
        if (!(share > 1.0) || goal.left <= goal.enough) return goal;
        far.step = onto_true_planes(touches_, share * goal.step, goal.normal, kPlane * radius_);
        return spend_leeway(far, goal, pull) ? far : goal;
    }

    NearestInside nearest_in(std::span<const HalfSpace> planes, const Vec3& pull) {
        ++result_.work.plane_solves;
        return nearest_inside(planes, pull, kPlane * radius_);
    }

    void only_no_deeper() {
        for (std::uint32_t i = 0; i < touches_.count; ++i)
            touches_.planes[i].offset = std::min(touches_.planes[i].offset, 0.0);
    }

    Goal goal_of(const NearestInside& plain, const Vec3& pull) {
        Goal goal;
        goal.found = plain.found;
        note_active(plain);
        goal.step = plain.point;
        goal.left = glm::length(goal.step);
        goal.in_contact = plain.bearing_count > 0;
        goal.is_hip = plain.found && !goal.in_contact;
        if (plain.found && goal.in_contact) goal.normal = unit_or_zero(goal.step - pull);
        goal.enough = enough(goal, pull);
        return goal;
    }

    // Whether the ball is deeper in a touched plane than sweeps and edges leave it: the surface has moved onto it.
    // Friction does not hold it there.
    [[nodiscard]] bool sunk() const {
        for (const HalfSpace& plane : touches_.span())
            if (plane.offset > kSunk * radius_) return true;
        return false;
    }

    // The goal with friction: only planes that the ball lies on bear it, not those that it would meet on its way.
    Goal held_goal() {
        const Vec3 pull = hip_ - center_;
        const std::uint32_t bearing = put_first_what_bears();
        if (bearing == 0) return falling(pull);
        const NearestInside plain = nearest_in(flat_.first(bearing), pull);
        Goal goal = goal_of(plain, pull);
        if (!goal.found || !goal.in_contact) return goal;
        if (settings_.shading) shade(goal, plain, pull, true);
        hold(goal, pull);
        const Vec3 slide = goal.step;
        onto_surface(goal);
        // Facets touched farther on, whose planes rise steeply, may lift the ball off the surface it slides on and away
        // from the HIP, and it would fall back for ever. It slides up to the first of them instead, which then bears it
        // too.
        if (glm::length(pull - goal.step) > glm::length(pull) + deepest_of(bearing) + still_) {
            goal.step = share_to_first(touches_.span(), slide) * slide;
            goal.left = glm::length(goal.step);
        }
        return goal;
    }

    // Greatest depth of the ball in its bearing planes, out of which it is lifted in any case.
    [[nodiscard]] double deepest_of(std::uint32_t bearing) const {
        double deepest = 0.0;
        for (std::uint32_t i = 0; i < bearing; ++i) deepest = std::max(deepest, touches_.planes[i].offset);
        return deepest;
    }

    // Moves the touches whose planes bear the ball to the front, and copies these planes, shifted through its centre,
    // to flat_. Returns their number.
    std::uint32_t put_first_what_bears() {
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < touches_.count; ++i) {
            if (touches_.planes[i].offset < -kBears * radius_) continue;
            std::swap(touches_.planes[i], touches_.planes[count]);
            std::swap(touches_.places[i], touches_.places[count]);
            HalfSpace plane = touches_.planes[count];
            plane.offset = 0.0;
            flat_.put(count++, plane);
        }
        return count;
    }

    // Moves towards the HIP until the first plane bears the ball.
    Goal falling(const Vec3& pull) {
        const double share = share_to_first(touches_.span(), pull);
        Goal goal;
        goal.found = true;
        goal.step = share * pull;
        goal.is_hip = share >= 1.0;
        note_active({});
        return goal;
    }

    // Among nearly parallel planes there may be no goal to be found although there is room.
    Goal creep() {
        const Vec3 pull = hip_ - center_;
        const WayAlong way = way_along(touches_.span(), pull, still_);
        Goal goal;
        goal.found = way.found;
        goal.step = way.step;
        goal.left = glm::length(way.whole);
        goal.in_contact = way.along_planes;
        goal.is_hip = way.found && way.step == pull;
        if (goal.in_contact) {
            goal.normal = unit_or_zero(way.whole - pull);
            note_most_opposed();
        }
        goal.enough = enough(goal, pull);
        return goal;
    }

    void shade(Goal& goal, const NearestInside& plain, const Vec3& pull, bool through_center) {
        ShadedPlanes planes = shaded(facets_, search_.candidates(), touches_, plain, center_, radius_);
        if (!planes.any) return;
        for (HalfSpace& plane : planes.planes)
            if (through_center) plane.offset = 0.0;
        const NearestInside smooth = nearest_in({planes.planes.data(), planes.count}, pull);
        if (!smooth.found || smooth.bearing_count == 0) return;
        goal.is_shaded = true;
        goal.step = smooth.point;
        goal.left = glm::length(goal.step);
        goal.normal = unit_or_zero(goal.step - pull);
        goal.enough = enough(goal, pull);
    }

    [[nodiscard]] double enough(const Goal& goal, const Vec3& pull) const {
        // Planes are reached exactly, in a step or two; only around edges and under shading does the rest come nearer
        // and nearer.
        if (!goal.is_shaded && result_.work.steps <= kPushingSteps) return still_;
        return std::max(still_, kStillAngle * -glm::dot(pull, goal.normal));
    }

    // Lets friction shorten the displacement along the surface, possibly to zero.
    void hold(Goal& goal, const Vec3& pull) {
        const double depth = -glm::dot(pull, goal.normal);
        const Vec3 along = pull + depth * goal.normal;
        const double coefficient = slips_ ? settings_.dynamic_friction : settings_.static_friction;
        double share = sliding_share(along, depth, coefficient);
        if (share > 0.0 && !slips_) share = sliding_share(along, depth, settings_.dynamic_friction);
        goal.left = share * glm::length(along);
        if (goal.left <= goal.enough) goal.left = share = 0.0;
        if (share > 0.0) slips_ = slid_ = true;
        goal.step = share * along;
    }

    // Moves the goal along the surface onto the true planes.
    void onto_surface(Goal& goal) {
        if (goal.step == Vec3(0.0)) return;
        const double share = std::max(step_share_.of(center_, goal.step), goal.is_shaded ? 0.0 : 1.0);
        goal.step = onto_true_planes(touches_, share * goal.step, goal.normal, kPlane * radius_);
        goal.left = std::min(goal.left, glm::length(goal.step) / share);
    }

    void note_active(const NearestInside& goal) {
        touched_.constraints = goal.bearing_count;
        if (goal.bearing_count == 0) return;
        std::uint32_t heaviest = 0;
        for (std::uint32_t i = 1; i < goal.bearing_count; ++i)
            if (goal.weights[i] > goal.weights[heaviest]) heaviest = i;
        note(goal.bearing[heaviest], goal.bearing_count);
        last_ = touched_;
    }

    void note_most_opposed() {
        double most = 0.0;
        for (std::uint32_t i = 0; i < touches_.count; ++i) {
            const double opposed = -glm::dot(touches_.planes[i].normal, hip_ - center_);
            if (opposed <= most) continue;
            most = opposed;
            note(i, 1);
        }
    }

    void note(std::uint32_t touch, std::uint32_t constraints) {
        const Touches::Place& place = touches_.places[touch];
        touched_ = {constraints, Candidates::is_point(place.candidate), 0, place.point};
        if (!touched_.is_point) touched_.triangle = search_.candidates().id(place.candidate);
    }

    [[nodiscard]] bool arrived(const Goal& goal) const {
        if (!goal.in_contact) return goal.is_hip && goal.step == Vec3(0.0);
        return goal.left <= goal.enough || (goal.is_shaded && result_.work.steps >= kShadingSteps);
    }

    enum class Going : std::uint8_t { on, arrived_free, out_of_work };

    // In contact the goal is near, so the broad phase is repeated around it before the ball moves. Out of contact the
    // goal may be the HIP deep inside while the surface is close, beyond an edge, so the ball first moves as far as the
    // surface is known.
    Going go(const Goal& goal) {
        const Vec3 end = center_ + goal.step;
        if (goal.in_contact && !search_.knows(end) && !(search_.broad_phase({center_, end}) && touch()))
            return Going::out_of_work;
        const double share = search_.known_share(center_, goal.step);
        const auto sweep = search_.sweep(center_, share * goal.step);
        if (!sweep.complete) return Going::out_of_work;
        const bool all = share >= 1.0 && sweep.fraction >= 1.0;
        if (all && goal.is_hip) return Going::arrived_free;
        center_ += (share * sweep.fraction) * goal.step;
        const bool unseen = share < 1.0 && sweep.fraction >= 1.0;
        return unseen && !search_.broad_phase({center_, end}) ? Going::out_of_work : Going::on;
    }

    // Free space: the proxy is the HIP, exactly. But a ball that was set between walls may slide along them to the HIP.
    ProxyResult free() {
        if (!was_set_ || !overlaps()) return result_;
        center_ = hip_;
        return unfit();
    }

    ProxyResult at_rest(const Goal& goal) {
        // Rounding alone must not move it: a hand that holds still feels the same force for ever.
        if (glm::length(center_ - began_) <= still_) center_ = began_;
        if (was_set_ && overlaps()) return unfit();
        stay();
        result_.sticking = !slid_ && settings_.static_friction > 0.0;
        result_.normal_object = goal.normal;
        return result_;
    }

    // Ends the tick early: the work budget is used up, or no goal was found among nearly parallel planes. The proxy
    // waits at a safe position and continues in the next tick; the planes it lies on still bear it.
    ProxyResult limited() {
        result_.work_limited = true;
        if (was_set_ && (!looked_ || overlaps())) return unfit();
        if (touched_.constraints == 0) note_most_opposed();
        // Between two facets no plane bears the ball: the last contact of this tick is reported.
        if (touched_.constraints == 0) touched_ = last_;
        // A proxy that could not even look around stays where it was in contact.
        if (touched_.constraints == 0 && touched_before_) touched_ = {1, false, ProxyResult{}.active_triangle, {}};
        stay();
        result_.normal_object = unit_or_zero(center_ - hip_);
        return result_;
    }

    // Tells whether a surface is deeper in the ball than kUnfit allows, or the centre is inside material.
    [[nodiscard]] bool overlaps() const {
        return nearest_.distance < (1.0 - kUnfit) * radius_ || nearest_.height < 0.0;
    }

    // The ball has been set where it does not fit, or it is not known yet whether it does. It is no contact, and goes
    // on from here for some ticks.
    ProxyResult unfit() {
        touched_ = {};
        stay();
        result_.next.touching = false;
        result_.next.unfit_ticks = std::min(unfit_ticks_ + 1, kMostUnfitTicks);
        return result_;
    }

    void stay() {
        result_.constraints = touched_.constraints;
        if (touched_.constraints > 0)
            result_.active_triangle = touched_.is_point ? search_.triangle_at(touched_.point) : touched_.triangle;
        result_.next.position_object_m = surface_.origin_object() + center_;
        result_.next.slipping = slid_;
        result_.next.touching = true;
        result_.next.motion_object_m = center_ - began_;
        result_.next.leeway_m = leeway_;
        result_.next.step_share = step_share_.last();
        result_.next.stride = search_.next_stride();
        result_.coarse = search_.was_coarse();
    }

    ProxySettings settings_;
    geometry::PosedSurface surface_;
    ProxyBudget budget_;
    double edge_, radius_, still_;
    Vec3 hip_, center_{0.0}, began_{0.0};
    ProxyResult result_;
    ContactSearch search_;
    SmoothFacets facets_;
    Touches touches_;
    StaticVector<HalfSpace, Touches::kMost> flat_;
    Nearest nearest_;
    StepShare step_share_;
    struct Touched {
        std::uint32_t constraints = 0;  // number of planes that bear the ball
        bool is_point = false;          // else a triangle
        std::uint32_t triangle = 0;     // what bears most of the contact
        Vec3 point{0.0};
    };
    Touched touched_, last_;  // now, and the last contact found in this tick
    double leeway_ = 0.0;
    std::uint32_t unfit_ticks_ = 0;
    bool was_set_ = false;         // not known to fit where this tick began
    bool looked_ = false;          // the last touch() was complete
    bool touched_before_ = false;  // in the last tick
    bool slips_ = false;           // the cone of dynamic friction applies, not the static one
    bool slid_ = false;            // in this tick
};

}  // namespace

ProxyResult move_proxy(const ProxyState& state, const Vec3& hip_object_m, const ProxySettings& settings,
                       const geometry::PosedSurface& surface, const ProxyBudget& budget) noexcept {
    if (!(surface.mean_edge_m() > 0.0)) {  // the surface is empty
        ProxyResult free;
        free.next = {hip_object_m, surface.surface().sequence, true};
        return free;
    }
    Mover mover(state, hip_object_m, settings, surface, budget);
    return mover.move(state);
}

}  // namespace burin::haptics
