// SPDX-License-Identifier: MIT
#include "haptics/contact/shape_proxy.hpp"

#include <algorithm>
#include <cmath>

#include "haptics/contact/friction.hpp"
#include "haptics/contact/setting.hpp"
#include "haptics/contact/shape_search.hpp"

namespace burin::haptics {
namespace {

// Fractions of the rounding: of planes' offsets, and of what is left to go, below which the tool is at rest; it is
// also where the HIP is off the normal by less than this angle.
constexpr double kOffset = 1e-6, kAtRest = 1e-4, kAtRestAngle = 1e-4;
// Of the rounding: a tool that is so deep gives way although the hand holds still; else it moves only if that brings it
// nearer by so much.
constexpr double kGivesWay = 4.0 * kEdge, kGains = 1e-3;
// Slack of a gathering: of the last motion, and of the tool's width. No step is longer than a part of the width.
constexpr double kOfMotion = 1.5, kOfSize = 0.02, kLongestStep = 0.5;
// A step that leaves what was gathered goes up to there, if that is more than this part of the slack. Else more is
// gathered, with a slack that is larger by this factor.
constexpr double kWorthGoing = 0.25, kFarther = 1.5;
// A turn that brings the tool deeper into something than this part of its width is halved, so often, before it is put
// off to the next tick.
constexpr int kTurnHalvings = 4;
// Of the tool's width: how far behind the place to which it has cut what touches goes at most.
constexpr double kNotYetKnown = 0.15;
// Parts of a way that is free, each as long as a step.
constexpr int kMostWays = 4;
constexpr double kTurnedInto = 0.1;
// A tool that its hand lifts may be so deep in facets that it lies between, as in its own bed: of a mean edge and of
// its width at most.
constexpr double kSqueezedOfEdge = 0.15, kSqueezedOfSize = 0.05;
// So deep, of the tool's width, a surface that is meshed anew may come into its hulls.
constexpr double kMeshedAnew = 0.25;
// A tool that was set somewhere fits where nothing is deeper in its rounding than this.
constexpr double kFits = 0.5;

Quat part_of_turn(const Quat& from, const Quat& to, double share) {
    if (share >= 1.0) return to;
    // Normalised linear interpolation: turns within a tick are small, and + - * / and sqrt give the same bits anywhere.
    const double sign = glm::dot(from, to) < 0.0 ? -1.0 : 1.0;
    const Quat q = from * (1.0 - share) + to * (sign * share);
    return q / std::sqrt(glm::dot(q, q));
}

// The motion of a tool's proxy in one tick, in the tool's axes.
class ShapeMover {
public:
    ShapeMover(const ProxyState& state, const ShapeMotion& motion, const ToolShape& shape,
               const geometry::PosedSurface& surface, const ProxyBudget& budget)
        : state_(state),
          motion_(motion),
          shape_(shape),
          surface_(surface),
          budget_(budget),
          search_(shape, surface, budget, result_.proxy.work),
          at_object_(state.placed ? state.position_object_m - surface.origin_object()
                                  : motion.hip_object_m - surface.origin_object()),
          slips_(state.slipping),
          unfit_ticks_(state.placed ? state.unfit_ticks : 0) {
        result_.orientation_object = motion.wanted;
        result_.proxy.next = {.position_object_m = motion.hip_object_m,
                              .surface_sequence = surface.surface().sequence,
                              .placed = true,
                              .hip_object_m = motion.hip_object_m};
        was_set_ = !state.placed || unfit_ticks_ > 0;
    }

    ShapeResult move() {
        if (unfit_ticks_ >= kMostUnfitTicks) return wait_outside();
        if (!begin()) return limited();
        if (is_free_) return result_;
        began_sunk_m_ = search_.sunk_m();
        if (is_buried()) return unfit();
        ShapeResult result = go_on();
        // There is no room for such a turn. One that brings the hulls into nothing is always possible.
        if (turned_into_ && search_.overlaps() && turn_a_little()) result = go_on();
        return result;
    }

private:
    ShapeResult go_on() {
        const Vec3 began = at_;
        for (std::uint32_t steps = 1;; ++steps) {
            ++result_.proxy.work.steps;
            if (!aim()) return limited();
            if (rests_) return at_rest(began);
            if (!go()) return limited();
            if (is_free_) return free();
            if (steps >= budget_.max_steps || !search_.touch(at_)) return limited();
        }
    }

    [[nodiscard]] Vec3 hip() const { return search_.to_tool(motion_.hip_object_m - surface_.origin_object()); }

    void turn(const Quat& orientation) {
        result_.orientation_object = orientation;
        search_.turn_to(orientation);
        at_ = search_.to_tool(at_object_);
        search_.draw_to(hip() - at_);
    }

    // Gathers what is near, and turns the tool as the hand does, as far as that leads into nothing. Looks around before
    // it turns: from there the planes are known that the tool must stay beyond.
    bool begin() {
        const bool turns = state_.placed && motion_.before != motion_.wanted;
        turn(turns ? motion_.before : motion_.wanted);
        const double way = turns ? angle_of_turn() * shape_.reach_m : 0.0;
        if (!turns && motion_.cut_to_object_m) follow_cut();
        if (!turns && lets_go()) return true;
        if (turns) {
            turn(motion_.wanted);
            if (lets_go()) return true;
            turn(motion_.before);
        }
        if (!search_.gather(at_, slack_of(std::min(way, shape_.size_m)))) return false;
        if (!turns) return touch_as_held();
        // A turn beyond what was gathered is finished in the next ticks.
        double share = way > 0.0 ? std::min(1.0, search_.slack() / way) : 1.0;
        turn(part_of_turn(motion_.before, motion_.wanted, share));
        if (!search_.touch(at_)) return false;
        if (!search_.overlaps()) return true;
        turn(motion_.before);
        if (!touch_as_held()) return false;
        if (search_.overlaps()) return true;
        for (int i = 0; i <= kTurnHalvings; ++i, share *= 0.5) {
            turn(part_of_turn(motion_.before, motion_.wanted, i < kTurnHalvings ? share : 0.0));
            if (!search_.touch(at_)) return false;
            if (search_.sunk_m() <= kTurnedInto * shape_.size_m) break;
        }
        turned_into_ = search_.overlaps();
        return true;
    }

    // A tool that cuts has been where it has cut to: what touches goes after it, as far as nothing is in its way.
    void follow_cut() {
        const Vec3 way = search_.to_tool(*motion_.cut_to_object_m - surface_.origin_object()) - at_;
        // The surface does not show yet what was cut last.
        const double known_m = glm::length(way) - kNotYetKnown * shape_.size_m;
        if (!state_.placed || was_set_ || !(known_m > 0.0)) return;
        const Vec3 step = bounded(way * (known_m / glm::length(way)));
        if (!search_.is_way_free(at_, step, squeezed_m())) return;
        at_ += step;
        at_object_ = search_.from_tool(at_);
    }

    // A hand that lifts its tool: where nothing is between the two any more nothing is touched, and the tool goes with
    // the hand.
    bool lets_go() {
        if (!state_.placed || was_set_ || holds_back()) return false;
        for (int parts = 0; parts < kMostWays; ++parts) {
            const Vec3 pull = hip() - at_, step = bounded(pull);
            if (!search_.is_way_free(at_, step, squeezed_m())) return false;
            at_ += step;
            at_object_ = search_.from_tool(at_);
            is_free_ = step == pull;
            if (is_free_) return true;
        }
        return false;
    }
    [[nodiscard]] double squeezed_m() const {
        return std::min(kSqueezedOfEdge * surface_.mean_edge_m(), kSqueezedOfSize * shape_.size_m);
    }

    bool touch_as_held() { return search_.touch(at_) && (!search_.overlaps() || pushed()); }

    // How far from here the tool may come in this tick; turned_m: by turning alone.
    [[nodiscard]] double slack_of(double turned_m) const {
        const double expected =
            holds_back() ? kOfMotion * glm::length(state_.motion_object_m) : 1.01 * glm::length(hip() - at_);
        return std::min(expected, kLongestStep * shape_.size_m) + kOfSize * shape_.size_m + turned_m;
    }

    // Whether the tool was held off the hand in the last tick, and the hand does not lead it away from there.
    [[nodiscard]] bool holds_back() const {
        return state_.touching && glm::dot(motion_.hip_object_m - state_.position_object_m,
                                           state_.hip_object_m - state_.position_object_m) > 0.0;
    }

    bool turn_a_little() {
        at_object_ = state_.position_object_m - surface_.origin_object();
        const double way = angle_of_turn() * shape_.reach_m;
        turn(part_of_turn(motion_.before, motion_.wanted, 0.5 * shape_.rounding_m / std::max(way, 1e-300)));
        return search_.gather(at_, kOfSize * shape_.size_m) && search_.touch(at_) && !search_.overlaps();
    }
    [[nodiscard]] double angle_of_turn() const {
        const Quat change = motion_.wanted * glm::conjugate(motion_.before);
        return 2.0 * glm::length(Vec3(change.x, change.y, change.z));
    }

    // The surface has come into the hulls. By a little it may, where it is meshed anew, and the tool then stays where
    // it is even if there is no way out at once.
    bool pushed() {
        result_.proxy.pushed_out = true;
        was_set_ = was_set_ || search_.sunk_m() > kMeshedAnew * shape_.size_m;
        return true;
    }

    // Wholly inside material, where no triangle is near.
    [[nodiscard]] bool is_buried() {
        if (state_.placed || !search_.planes().empty()) return false;
        return is_inside(search_.from_tool(at_ + shape_.inside_m));
    }
    [[nodiscard]] bool is_inside(const Vec3& place) {
        ContactSearch nearest_to(surface_, 0.5 * shape_.size_m, budget_, result_.proxy.work);
        const Nearest nearest = nearest_to.nearest(place, known_around(place, surface_));
        return inside_material(nearest, place, surface_) &&
               nearest_to.sees_backs(place, 1.5 * nearest.distance + surface_.mean_edge_m());
    }

    // Finds the next place and what bears the tool there.
    bool aim() {
        const Vec3 pull = hip() - at_;
        rests_ = in_contact_ = slid_ = false;
        step_ = pull;
        if (search_.planes().empty()) {
            bearing_ = {};
            return true;
        }
        ++result_.proxy.work.plane_solves;
        const NearestInside goal = nearest_inside(search_.planes(), pull, kOffset * shape_.rounding_m);
        if (!goal.found) return creep(pull);
        bearing_ = goal;
        in_contact_ = goal.bearing_count > 0;
        step_ = goal.point;
        if (!in_contact_) return true;
        const Vec3 spring = goal.point - pull;
        const double depth = glm::length(spring);
        if (depth > 0.0) normal_ = spring / depth;
        note_touched(goal);
        if (motion_.static_friction > 0.0 || motion_.dynamic_friction > 0.0) {
            // Nothing holds a tool back before it has come to what will bear it.
            if (!touches_here()) return come_nearer(pull);
            hold(pull);
        }
        const double enough = std::max(kAtRest * shape_.rounding_m,
                                       result_.proxy.work.steps > 2 ? kAtRestAngle * std::max(depth, 0.0) : 0.0);
        rests_ = glm::length(step_) <= enough;
        return true;
    }

    // Among nearly parallel planes there may be no goal to be found although there is room.
    bool creep(const Vec3& pull) {
        const double least = kAtRest * shape_.rounding_m;
        in_contact_ = true;
        step_ = way_out(search_.planes(), least);
        if (glm::length(step_) > least) return true;
        const WayAlong way = way_along(search_.planes(), pull, least);
        step_ = way.step;
        return way.found;
    }

    [[nodiscard]] bool touches_here() const {
        const double least = -2.0 * kReached * shape_.rounding_m;
        return std::ranges::any_of(search_.planes(), [&](const HalfSpace& plane) { return plane.offset >= least; });
    }

    bool come_nearer(const Vec3& pull) {
        step_ = share_to_first(search_.planes(), pull) * pull;
        return true;
    }

    // Friction: the tool stays where it is, but for what it must give way, or slides up to the cone.
    void hold(const Vec3& pull) {
        ++result_.proxy.work.plane_solves;
        const NearestInside stays = nearest_inside(search_.planes(), Vec3(0.0), kOffset * shape_.rounding_m);
        if (!stays.found) return;
        const Vec3 way = step_ - stays.point;
        const Vec3 along = way - glm::dot(way, normal_) * normal_;
        const double depth = glm::dot(stays.point - pull, normal_);
        double share = sliding_share(along, depth, slips_ ? motion_.dynamic_friction : motion_.static_friction);
        if (share > 0.0 && !slips_) share = sliding_share(along, depth, motion_.dynamic_friction);
        if (share * glm::length(along) <= std::max(kAtRest * shape_.rounding_m, kAtRestAngle * depth)) share = 0.0;
        step_ = stays.point + share * way;
        if (share > 0.0) slips_ = slid_before_ = true;
        slid_ = slid_before_;
        bearing_constraints_ = std::max(bearing_.bearing_count, 1u);
    }

    void note_touched(const NearestInside& goal) {
        Vec3 sum(0.0);
        double weights = 0.0, most = -1.0;
        for (std::uint32_t k = 0; k < goal.bearing_count; ++k) {
            const std::uint32_t plane = goal.bearing[k];
            sum += goal.weights[k] * search_.touched(plane);
            weights += goal.weights[k];
            if (goal.weights[k] > most) most = goal.weights[k], heaviest_ = plane;
        }
        touched_ = weights > 0.0 ? sum / weights : search_.touched(heaviest_);
        bearing_constraints_ = goal.bearing_count;
    }

    [[nodiscard]] Vec3 bounded(const Vec3& step) const {
        const double length = glm::length(step), longest = kLongestStep * shape_.size_m;
        return length > longest ? step * (longest / length) : step;
    }

    bool go() {
        Vec3 step = bounded(step_);
        if (search_.covered_share(at_, step) < std::min(1.0, kWorthGoing * search_.slack() / glm::length(step))) {
            // What is seen anew may be touched where it was not before, so that the step is found anew.
            const double slack = in_contact_ ? kFarther * search_.slack() : HUGE_VAL;
            if (!search_.gather(at_, std::min(slack, 1.01 * glm::length(step))) || !search_.touch(at_) || !aim())
                return false;
            if (rests_) return true;
            step = bounded(step_);
        }
        step *= search_.covered_share(at_, step);
        const ShapeSearch::Sweep sweep = search_.sweep(at_, step);
        at_ += sweep.fraction * step;
        at_object_ = search_.from_tool(at_);
        if (!sweep.complete) return false;
        is_free_ = !in_contact_ && sweep.fraction >= 1.0 && step == step_;
        return true;
    }

    [[nodiscard]] bool fits() const { return !search_.overlaps() && search_.sunk_m() <= kFits * shape_.rounding_m; }

    ShapeResult free() {
        if (!was_set_ || (search_.touch(at_) && fits())) return result_;
        return unfit();
    }

    ShapeResult at_rest(const Vec3& began) {
        if (glm::length(at_ - began) <= kAtRest * shape_.rounding_m) at_ = began;
        at_object_ = search_.from_tool(at_);
        if (was_set_ && !fits()) return unfit();
        stay(began);
        result_.proxy.sticking = !slid_ && motion_.static_friction > 0.0;
        return result_;
    }

    ShapeResult limited() {
        result_.proxy.work_limited = true;
        at_object_ = search_.from_tool(at_);
        if (was_set_ && !fits()) return unfit();
        if (search_.overlaps()) {
            // There is no room for the turn: it is put off.
            at_object_ = state_.position_object_m - surface_.origin_object();
            turn(motion_.before);
        }
        if (bearing_constraints_ == 0 && state_.placed && state_.touching) bearing_constraints_ = 1;
        const Vec3 spring = at_ - hip();
        const double depth = glm::length(spring);
        if (depth > 0.0) normal_ = spring / depth;
        stay(at_);
        return result_;
    }

    // A tool that could not be pushed out follows the hand without contact until it fits where the hand is.
    ShapeResult wait_outside() {
        at_object_ = motion_.hip_object_m - surface_.origin_object();
        turn(motion_.wanted);
        const bool looked = search_.gather(at_, kOfSize * shape_.size_m) && search_.touch(at_);
        if (!looked || !fits() || is_inside(search_.from_tool(at_ + shape_.inside_m))) return unfit();
        return result_;
    }

    ShapeResult unfit() {
        bearing_constraints_ = 0;
        stay(at_);
        result_.proxy.next.touching = false;
        result_.proxy.next.unfit_ticks = std::min(unfit_ticks_ + 1, kMostUnfitTicks);
        return result_;
    }

    // Under a hand that holds still only what brings the tool nearer to it is a motion, unless it has to give way. So
    // every motion ends.
    [[nodiscard]] bool gains_nothing() const {
        const bool holds_still = state_.placed && state_.touching && state_.unfit_ticks == 0 &&
                                 state_.hip_object_m == motion_.hip_object_m &&
                                 state_.surface_sequence == surface_.surface().sequence &&
                                 motion_.before == result_.orientation_object;
        if (!holds_still || began_sunk_m_ > kGivesWay * shape_.rounding_m) return false;
        const double before = glm::length(state_.position_object_m - motion_.hip_object_m);
        const double now = glm::length(surface_.origin_object() + at_object_ - motion_.hip_object_m);
        return now > before - kGains * shape_.rounding_m;
    }

    void stay(const Vec3& began) {
        ProxyResult& proxy = result_.proxy;
        proxy.constraints = bearing_constraints_;
        if (bearing_constraints_ > 0) {
            proxy.normal_object = search_.from_tool(normal_);
            if (heaviest_ < search_.planes().size()) proxy.active_triangle = search_.triangle(heaviest_);
            result_.touched_object_m = surface_.origin_object() + search_.from_tool(touched_);
        }
        proxy.next.slipping = slid_;
        proxy.next.touching = true;
        if (gains_nothing()) {
            proxy.next.position_object_m = state_.position_object_m;
            return;
        }
        proxy.next.position_object_m = surface_.origin_object() + at_object_;
        proxy.next.motion_object_m = search_.from_tool(at_ - began);
    }

    const ProxyState& state_;
    const ShapeMotion& motion_;
    const ToolShape& shape_;
    geometry::PosedSurface surface_;
    ProxyBudget budget_;
    ShapeResult result_;
    ShapeSearch search_;
    Vec3 at_object_, at_{0.0}, step_{0.0}, normal_{0.0}, touched_{0.0};
    NearestInside bearing_;
    std::uint32_t bearing_constraints_ = 0, heaviest_ = 0;
    bool slips_, rests_ = false, in_contact_ = false, is_free_ = false;
    bool slid_ = false, slid_before_ = false;  // in this step, and in this tick
    std::uint32_t unfit_ticks_;
    double began_sunk_m_ = 0.0;
    bool was_set_ = false;
    bool turned_into_ = false;  // the turn has brought the hulls into something
};

}  // namespace

ShapeResult move_shape(const ProxyState& state, const ShapeMotion& motion, const ToolShape& shape,
                       const geometry::PosedSurface& surface, const ProxyBudget& budget) noexcept {
    if (!(surface.mean_edge_m() > 0.0)) {  // the surface is empty
        ShapeResult free;
        free.proxy.next = {motion.hip_object_m, surface.surface().sequence, true};
        free.orientation_object = motion.wanted;
        return free;
    }
    return ShapeMover(state, motion, shape, surface, budget).move();
}

}  // namespace burin::haptics
