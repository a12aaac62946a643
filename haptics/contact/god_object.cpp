// SPDX-License-Identifier: MIT
#include "haptics/contact/god_object.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "haptics/contact/friction.hpp"
#include "haptics/contact/shading.hpp"
#include "haptics/contact/touching.hpp"

namespace burin {
namespace {

// As fractions of the ball's radius; kTouch and kTie are in touching.hpp.
constexpr double kPlane = 1e-9;  // rounding of plane offsets, far below anything felt
constexpr double kPointProbeOfEdge = 1.0 / 500.0;
// The proxy stands still when it moves less than this fraction of the radius, or of a twentieth of an edge if that is
// more; under shading also when the HIP is off the normal by less than this angle, a tenth of what a hand may notice.
constexpr double kStill = 1e-5, kStillAngle = 1e-4;

// A plane bears the ball when it is no farther off than this; with friction.
constexpr double kBears = 1e-4;

constexpr double kSunk = 5e-3;

// Inside or outside is voted on by what is within this many times the distance of the nearest triangle.
constexpr double kVote = 1.5;

// Pushing out the thousandth of R that edges may sink in can go back and forth between facets. After these steps the
// ball is only kept from going deeper, so that each step brings it nearer to the HIP and the steps come to an end.
constexpr std::uint32_t kPushingSteps = 3;
// Shading converges in two or three steps. Where it does not, as in a corner of the smooth surface, the ball is left where these took it.
constexpr std::uint32_t kShadingSteps = 10;

Vec3 unit_or_zero(const Vec3& v) {
    const double length2 = glm::dot(v, v);
    return length2 > 0.0 ? v / std::sqrt(length2) : Vec3(0.0);
}

// How far around `center` the surface is known; negative outside the known ball.
double known_around(const Vec3& center, const LocalSurface& surface) {
    const Vec3 off = center - (surface.center_object - surface.origin_object);
    return surface.radius_m - std::sqrt(glm::dot(off, off));
}

// Only where the ball around `center` that reaches the nearest triangle lies within what is known is "nearest" the
// truth.
bool inside_material(const Nearest& nearest, const Vec3& center, const LocalSurface& surface) {
    return nearest.height < 0.0 && nearest.distance <= known_around(center, surface);
}

Vec3 put_outside(const Nearest& nearest, const Vec3& center, double radius) {
    const bool on_surface = nearest.distance < kTie * radius;
    const Vec3 way = on_surface ? nearest.normal : (nearest.point - center) / nearest.distance;
    return nearest.point + radius * way;
}

// Where the ball is to go from where it is, and what bears it there.
struct Goal {
    bool found = false;
    Vec3 step{0.0};     // from the centre
    Vec3 normal{0.0};   // unit, of the contact; zero in free space
    double left = 0.0;  // how far it is to where nothing draws it on
    double enough = 0.0;
    bool in_contact = false;
    bool is_shaded = false;
    bool is_hip = false;  // nothing in the way is known of
};

// One tick's worth of proxy motion. Everything is relative to the surface's origin.
class Mover {
public:
    Mover(const ProxyState& state, const Vec3& hip_object_m, const ProxySettings& settings, const LocalSurface& surface,
          const ProxyBudget& budget)
        : settings_(settings),
          surface_(surface),
          budget_(budget),
          edge_(surface.mean_edge_m()),
          radius_(std::max(settings.contact_radius_m, kPointProbeOfEdge * edge_)),
          still_(kStill * std::max(radius_, 0.05 * edge_)),
          hip_(hip_object_m - surface.origin_object),
          search_(surface, radius_, budget, result_.work),
          facets_(surface) {
        result_.next = {hip_object_m, surface.sequence, true};
        center_ = state.placed ? state.position_object_m - surface.origin_object : hip_;
        slips_ = state.slipping;
    }

    ProxyResult move(const ProxyState& state) {
        began_ = center_;
        if (!begin(state)) return limited();
        began_ = center_;
        for (;;) {
            ++result_.work.steps;
            const Goal goal = aim();
            if (!goal.found) return limited();
            if (arrived(goal)) return goal.in_contact ? at_rest(goal) : free();
            const Going going = go(goal);
            if (going == Going::arrived_free) return free();
            if (going == Going::out_of_work || result_.work.steps >= budget_.max_steps || !touch()) return limited();
        }
    }

private:
    // Looks where the ball will probably go: on along the surface as it went, or to the HIP. And puts it outside if it is
    // inside material.
    bool begin(const ProxyState& state) {
        const Vec3 pull = hip_ - center_;
        Vec3 onward = state.touching ? state.motion_object_m : pull;
        if (glm::dot(onward, onward) > 4.0 * glm::dot(pull, pull) + radius_ * radius_)
            onward = Vec3(0.0);  // not of this walk
        if (!search_.look_along({center_, center_ + onward}) || !touch()) return false;
        const bool unsure = !state.placed || state.surface_sequence != surface_.sequence;
        if (unsure && !(nearest_.distance < HUGE_VAL))
            nearest_ = search_.nearest(center_, known_around(center_, surface_));
        if (!inside_material(nearest_, center_, surface_)) return true;
        // A facet folded over may be the nearest, and show its back to a ball that is outside.
        if (!search_.sees_backs(center_, kVote * nearest_.distance + edge_)) return true;
        center_ = put_outside(nearest_, center_, radius_);
        result_.pushed_out = true;
        return search_.look_along({center_, center_}) && touch();
    }

    bool touch() {
        const auto touching = search_.touching(center_, touches_);
        nearest_ = touching.nearest;
        return touching.complete;
    }

    Goal aim() {
        const bool pushing = result_.work.steps <= kPushingSteps;
        if (!pushing) only_no_deeper();
        const bool rubs = settings_.static_friction > 0.0 || settings_.dynamic_friction > 0.0;
        if (rubs && touches_.count > 0 && !(pushing && sunk())) return held_goal();
        const Vec3 pull = hip_ - center_;
        NearestInside plain = nearest_in(touches_.span(), pull);
        if (!plain.found && pushing) {  // there is no room to be pushed out into
            only_no_deeper();
            plain = nearest_in(touches_.span(), pull);
        }
        Goal goal = goal_of(plain, pull);
        if (!goal.found || !goal.in_contact || !settings_.shading) return goal;
        shade(goal, plain, pull, false);
        if (goal.is_shaded) onto_surface(goal);
        return goal;
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
        goal.enough = still_;
        goal.in_contact = plain.bearing_count > 0;
        goal.is_hip = plain.found && !goal.in_contact;
        if (plain.found && goal.in_contact) goal.normal = unit_or_zero(goal.step - pull);
        return goal;
    }

    // Deeper in what it touches than sweeps and edges leave it: the surface has come to it. Friction does not hold it there.
    [[nodiscard]] bool sunk() const {
        for (const HalfSpace& plane : touches_.span())
            if (plane.offset > kSunk * radius_) return true;
        return false;
    }

    // With friction: what bears the ball is what it lies on, not what it would come to on its way.
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
        // Facets touched farther on, whose planes rise steeply, may lift the ball off what it slides on and away from the HIP, and it
        // would fall back for ever. It slides up to the first of them instead, which then bears it too.
        if (glm::length(pull - goal.step) > glm::length(pull) + deepest_of(bearing) + still_) {
            goal.step = share_to_first_plane(slide) * slide;
            goal.left = glm::length(goal.step);
        }
        return goal;
    }

    // How deep the ball is in what bears it, out of which it is lifted in any case.
    [[nodiscard]] double deepest_of(std::uint32_t bearing) const {
        double deepest = 0.0;
        for (std::uint32_t i = 0; i < bearing; ++i) deepest = std::max(deepest, touches_.planes[i].offset);
        return deepest;
    }

    // The planes that the ball is on, through its centre, in flat_; they come first among the touches too.
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

    [[nodiscard]] double share_to_first_plane(const Vec3& way) const {
        double share = 1.0;
        for (const HalfSpace& plane : touches_.span()) {
            const double sinking = glm::dot(plane.normal, way);
            if (sinking < 0.0) share = std::min(share, plane.offset / sinking);
        }
        return std::max(share, 0.0);
    }

    // Towards the HIP until the first plane bears the ball.
    Goal falling(const Vec3& pull) {
        const double share = share_to_first_plane(pull);
        Goal goal;
        goal.found = true;
        goal.step = share * pull;
        goal.is_hip = share >= 1.0;
        note_active({});
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
        goal.enough = std::max(still_, kStillAngle * -glm::dot(pull, goal.normal));
    }

    // Friction takes its part of the way along the surface, or all of it.
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

    // Where the ball is wanted along the surface, but on the true planes.
    void onto_surface(Goal& goal) {
        if (goal.step == Vec3(0.0)) return;
        const double share = goal.is_shaded ? step_share_.of(center_, goal.step) : 1.0;
        goal.step = onto_true_planes(touches_, share * goal.step, goal.normal, kPlane * radius_);
    }

    void note_active(const NearestInside& goal) {
        result_.constraints = goal.bearing_count;
        if (goal.bearing_count == 0) return;
        std::uint32_t heaviest = 0;
        for (std::uint32_t i = 1; i < goal.bearing_count; ++i)
            if (goal.weights[i] > goal.weights[heaviest]) heaviest = i;
        result_.active_triangle = touches_.planes[goal.bearing[heaviest]].triangle;
        last_ = {result_.constraints, result_.active_triangle};
    }

    void note_most_opposed() {
        double most = 0.0;
        for (const HalfSpace& plane : touches_.span()) {
            const double opposed = -glm::dot(plane.normal, hip_ - center_);
            if (opposed <= most) continue;
            most = opposed;
            result_.constraints = 1;
            result_.active_triangle = plane.triangle;
        }
    }

    [[nodiscard]] bool arrived(const Goal& goal) const {
        if (!goal.in_contact) return goal.is_hip && goal.step == Vec3(0.0);
        return goal.left <= goal.enough || (goal.is_shaded && result_.work.steps >= kShadingSteps);
    }

    enum class Going : std::uint8_t { on, arrived_free, out_of_work };

    // In contact the goal is near, and is looked at before the ball goes there. Out of contact it may be the HIP deep inside, while
    // the surface is a hair's breadth away, beyond an edge: the ball goes as far as is known first.
    Going go(const Goal& goal) {
        const Vec3 end = center_ + goal.step;
        if (goal.in_contact && !search_.knows(end) && !(search_.look_along({center_, end}) && touch()))
            return Going::out_of_work;
        const double share = search_.known_share(center_, goal.step);
        const auto sweep = search_.sweep(center_, share * goal.step);
        if (!sweep.complete) return Going::out_of_work;
        const bool all = share >= 1.0 && sweep.fraction >= 1.0;
        if (all && goal.is_hip) return Going::arrived_free;
        center_ += (share * sweep.fraction) * goal.step;
        const bool unseen = share < 1.0 && sweep.fraction >= 1.0;
        return unseen && !search_.look_along({center_, end}) ? Going::out_of_work : Going::on;
    }

    // The proxy is the HIP, exactly.
    ProxyResult free() {
        result_.constraints = 0;
        result_.active_triangle = ProxyResult{}.active_triangle;
        return result_;
    }

    ProxyResult at_rest(const Goal& goal) {
        if (goal.left <= still_) center_ += goal.step;
        stay();
        result_.sticking = !slid_ && settings_.static_friction > 0.0;
        result_.normal_object = goal.normal;
        return result_;
    }

    // Work is used up, or no goal was found among planes that nearly agree: the proxy waits where it is safe, and goes on in the
    // next tick. What it lies on bears it all the same.
    ProxyResult limited() {
        result_.work_limited = true;
        if (result_.constraints == 0) note_most_opposed();
        if (result_.constraints == 0 && last_.constraints > 0) {  // between two facets on its way
            result_.constraints = last_.constraints;
            result_.active_triangle = last_.triangle;
        }
        stay();
        result_.normal_object = unit_or_zero(center_ - hip_);
        return result_;
    }

    void stay() {
        result_.next.position_object_m = surface_.origin_object + center_;
        result_.next.slipping = slid_;
        result_.next.touching = true;
        result_.next.motion_object_m = center_ - began_;
    }

    ProxySettings settings_;
    const LocalSurface& surface_;
    ProxyBudget budget_;
    double edge_, radius_, still_;
    Vec3 hip_, center_{0.0}, began_{0.0};
    ProxyResult result_;
    ContactSearch search_;
    SmoothFacets facets_;
    Touches touches_;
    Room<HalfSpace, Touches::kMost> flat_;
    Nearest nearest_;
    StepShare step_share_;
    struct {
        std::uint32_t constraints = 0, triangle = 0;
    } last_;              // what bore the ball last in this tick
    bool slips_ = false;  // of the two cones it is the dynamic one that holds
    bool slid_ = false;   // in this tick
};

}  // namespace

ProxyResult move_proxy(const ProxyState& state, const Vec3& hip_object_m, const ProxySettings& settings,
                       const LocalSurface& surface, const ProxyBudget& budget) noexcept {
    if (!(surface.mean_edge_m() > 0.0)) {  // nothing there to touch
        ProxyResult free;
        free.next = {hip_object_m, surface.sequence, true};
        return free;
    }
    Mover mover(state, hip_object_m, settings, surface, budget);
    return mover.move(state);
}

}  // namespace burin
