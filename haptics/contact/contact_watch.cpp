// SPDX-License-Identifier: MIT
#include "haptics/contact/contact_watch.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/shape_watch.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin::haptics {
namespace {

// Distances found by one look around a place.
struct Seen {
    double distance_m = HUGE_VAL, height_m = 0.0;  // of the nearest triangle
    double ahead_m = HUGE_VAL;                     // distance of the nearest one a step ahead
    bool complete = true;
};

constexpr double kWatchTie = 1e-6;  // of the reach

// A cheap test before the exact one: the ball around the triangle's bounding box lies beyond the reach.
bool is_beyond(const geometry::Triangle& t, const Vec3& center, double reach_m) {
    const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
    const double most = reach_m + 0.5 * glm::length(hi - lo) * (1.0 + 1e-9);
    const Vec3 off = 0.5 * (lo + hi) - center;
    return glm::dot(off, off) > most * most;
}

// The work of a look, and what it may cost.
struct LookWork {
    ContactWork& done;
    double most_ns;

    [[nodiscard]] double left_ns() const { return most_ns + WorkCost::kTick_ns - cost_ns(done); }
};

// With a step, looks at all triangles in reach, else for the nearest one alone.
Seen look_around(const Vec3& center, double reach_m, const Vec3& step, const geometry::PosedSurface& surface,
                 const LookWork& work) {
    Seen seen;
    const bool only_nearest = step == Vec3(0.0);
    geometry::Near near{.lo = center, .hi = center, .reach_m = reach_m, .by_way = true, .from = center, .to = center};
    SearchWork paid(work.left_ns(), ContactWatch::kMostLooks, near.looks_left);
    seen.complete = geometry::for_each_triangle_near(surface, near, [&](std::uint32_t id, const geometry::Triangle& t) {
        if (is_beyond(t, center, near.reach_m)) return true;
        if (!paid.pay_test()) return false;
        const Vec3 off = center - nearest_on_triangle(center, t).point;
        const double distance_m = glm::length(off);
        if (distance_m > reach_m) return true;
        if (!only_nearest) {
            const Vec3 ahead = center + step;
            seen.ahead_m = std::min(seen.ahead_m, glm::length(ahead - nearest_on_triangle(ahead, t).point));
        }
        double height_m = glm::dot(off, outward_normal(t));
        if (surface.two_sided(id)) height_m = std::abs(height_m);
        // An edge or corner is nearest on several triangles alike; the side is that of the one seen most squarely.
        const bool nearer = distance_m < seen.distance_m - kWatchTie * reach_m;
        if (nearer ||
            (distance_m <= seen.distance_m + kWatchTie * reach_m && std::abs(height_m) > std::abs(seen.height_m)))
            seen.distance_m = distance_m, seen.height_m = height_m;
        if (only_nearest) near.reach_m = std::min(near.reach_m, seen.distance_m * (1.0 + kWatchTie));
        return true;
    });
    work.done.triangles_tested += paid.tests();
    work.done.triangles_seen += paid.looks();
    return seen;
}

// Outside of all material, with the ball clear of it. Looked for in balls that double, as far as the looks suffice.
bool is_free(const Vec3& hand, double radius_m, const geometry::PosedSurface& surface, const LookWork& work,
             bool if_unknown) {
    const Box all = geometry::bounds(surface);
    const double everything = glm::length(glm::max(glm::abs(hand - all.lo), glm::abs(hand - all.hi)));
    for (double reach_m = radius_m;; reach_m *= 2.0) {
        const Seen seen = look_around(hand, reach_m, Vec3(0.0), surface, work);
        if (seen.distance_m <= radius_m) return false;
        // Where looks did not suffice a hand that does not cut counts as free, so that no unproved contact holds it.
        if (!seen.complete) return if_unknown;
        if (reach_m > everything) return seen.height_m >= 0.0;
        if (seen.distance_m <= reach_m) return seen.height_m >= 0.0;
    }
}

// Where the tests do not suffice the tool counts as clear, as a ball does.
bool is_free(const PosedShape& tool, const geometry::PosedSurface& surface, const LookWork& work, bool if_unknown) {
    const Held touches = touches_something(tool, surface, work.done);
    return (touches == Held::no || (touches == Held::unknown && if_unknown)) &&
           is_free(tool.inside(), 0.1 * tool.shape.size_m, surface, work, if_unknown);
}

// Whether a tool's contact is found wanting while the hand is clear.
bool is_doubtful(const ContactWatch::Contact& contact, const Vec3& way, bool falls_behind,
                 const geometry::PosedSurface& surface, const LookWork& work) {
    const Held held = is_held({*contact.shape, contact.proxy_m, contact.proxy_orientation}, way, surface, work.done);
    return (falls_behind || held == Held::no) &&
           is_free({*contact.shape, contact.hand_m, contact.hand_orientation}, surface, work, !contact.cuts);
}

// Whether a ball's contact is seen not to be one.
bool is_unsound(const ContactWatch::Contact& contact, const Vec3& step, const geometry::PosedSurface& surface,
                const LookWork& work) {
    const double radius_m = contact.radius_m;
    const Seen seen = look_around(contact.proxy_m, ContactWatch::kTouching * radius_m, step, surface, work);
    const bool fits = seen.distance_m >= (1.0 - ContactWatch::kDeep) * radius_m && seen.height_m >= 0.0;
    const bool in_the_way = seen.distance_m - seen.ahead_m > ContactWatch::kInTheWay * glm::length(step);
    return seen.complete && !(fits && in_the_way);
}

}  // namespace

void ContactWatch::look(WatchState& state, const Contact& contact, const geometry::PosedSurface& surface,
                        ContactWork& done, double most_ns) noexcept {
    const LookWork work{done, most_ns + cost_ns(done) - WorkCost::kTick_ns};
    if (state.ticks_to_look > 0) {
        --state.ticks_to_look;
        return;
    }
    state.ticks_to_look = kInterval - 1;
    const double radius_m = contact.radius_m;
    const Vec3 pull = contact.hand_m - contact.proxy_m;
    const double pull_m = glm::length(pull), step_m = kStep * radius_m;
    if (!(pull_m > 0.0)) return;
    const bool falls_behind = state.short_ticks >= kShort;
    if (contact.shape != nullptr) {
        const bool doubtful = is_doubtful(contact, pull / pull_m, falls_behind, surface, work);
        state.doubtful_looks = doubtful ? std::min(state.doubtful_looks + 1, kLooks) : 0;
        return;
    }
    const bool doubtful = falls_behind || is_unsound(contact, (step_m / pull_m) * pull, surface, work);
    if (doubtful && is_free(contact.hand_m, radius_m, surface, work, !contact.cuts))
        state.doubtful_looks = std::min(state.doubtful_looks + 1, kLooks);
    else
        state.doubtful_looks = 0;
}

void ContactWatch::note(WatchState& state, bool work_limited) noexcept {
    state.short_ticks = work_limited ? std::min(state.short_ticks, kShort) + 1 : 0;
}

bool ContactWatch::gives_up(WatchState& state) noexcept {
    if (state.doubtful_looks >= kLooks)
        ++state.faded_ticks;
    else if (state.faded_ticks > 0)
        --state.faded_ticks;
    if (state.faded_ticks < kFade) return false;
    state = {};
    return true;
}

}  // namespace burin::haptics
