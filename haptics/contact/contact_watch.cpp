// SPDX-License-Identifier: MIT
#include "haptics/contact/contact_watch.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/contact/local_surface_search.hpp"
#include "haptics/contact/separation.hpp"
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

// What touches, a ball or a tool's shape, and how far it is from triangles.
class Body {
public:
    Body(const ContactWatch::Contact& contact, const Quat& orientation)
        : shape_(contact.shape), radius_m_(contact.radius_m) {
        if (shape_ != nullptr) turn_ = glm::mat3_cast(orientation);
    }
    [[nodiscard]] double radius_m() const { return radius_m_; }
    // How much farther than a ball of its radius it reaches.
    [[nodiscard]] double beyond_m() const { return shape_ != nullptr ? shape_->reach_m : 0.0; }
    // A place inside it.
    [[nodiscard]] Vec3 inside(const Vec3& place) const {
        return shape_ != nullptr ? place + turn_ * shape_->inside_m : place;
    }
    // As of a ball's centre.
    [[nodiscard]] double distance_m(const Vec3& place, const geometry::Triangle& t, ContactWork& work) const {
        if (shape_ == nullptr) return glm::length(place - nearest_on_triangle(place, t).point);
        const geometry::Triangle in_tool{(t.a - place) * turn_, (t.b - place) * turn_, (t.c - place) * turn_};
        double least = HUGE_VAL;
        for (std::uint32_t i = 0; i < shape_->piece_count; ++i) {
            const SeparationQuery query{Vec3(0.0), shape_->inside_m - in_tool.a + Vec3(1e-9), least,
                                        0.1 * shape_->rounding_m};
            const Separation found = separation(*shape_, shape_->pieces[i], in_tool, query);
            work.supports += found.supports;
            least = std::min(least, found.overlaps ? 0.0 : found.gap_m);
        }
        return least + std::max(radius_m_ - shape_->rounding_m, 0.0);
    }

private:
    const ToolShape* shape_;
    double radius_m_;
    glm::dmat3 turn_{1.0};
};

// A cheap test before the exact one: the ball around the triangle's bounding box lies beyond the reach.
bool is_beyond(const geometry::Triangle& t, const Vec3& center, double reach_m) {
    const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
    const double most = reach_m + 0.5 * glm::length(hi - lo) * (1.0 + 1e-9);
    const Vec3 off = 0.5 * (lo + hi) - center;
    return glm::dot(off, off) > most * most;
}

// With a step, looks at all triangles in reach, else for the nearest one alone.
Seen look_around(const Body& body, const Vec3& center, double reach_m, const Vec3& step,
                 const geometry::PosedSurface& surface, ContactWork& work) {
    Seen seen;
    const bool only_nearest = step == Vec3(0.0);
    const double beyond_m = body.beyond_m();
    const Vec3 inside = body.inside(center);
    geometry::Near near{
        .lo = center, .hi = center, .reach_m = reach_m + beyond_m, .by_way = true, .from = center, .to = center};
    near.looks_left = ContactWatch::kMostLooks;
    seen.complete = geometry::for_each_triangle_near(surface, near, [&](std::uint32_t id, const geometry::Triangle& t) {
        if (is_beyond(t, center, near.reach_m)) return true;
        ++work.triangles_tested;
        const double distance_m = body.distance_m(center, t, work);
        if (distance_m > reach_m) return true;
        if (!only_nearest) seen.ahead_m = std::min(seen.ahead_m, body.distance_m(center + step, t, work));
        double height_m = glm::dot(inside - nearest_on_triangle(inside, t).point, outward_normal(t));
        if (surface.two_sided(id)) height_m = std::abs(height_m);
        // An edge or corner is nearest on several triangles alike; the side is that of the one seen most squarely.
        const bool nearer = distance_m < seen.distance_m - kWatchTie * reach_m;
        if (nearer ||
            (distance_m <= seen.distance_m + kWatchTie * reach_m && std::abs(height_m) > std::abs(seen.height_m)))
            seen.distance_m = distance_m, seen.height_m = height_m;
        if (only_nearest) near.reach_m = std::min(near.reach_m, seen.distance_m * (1.0 + kWatchTie) + beyond_m);
        return true;
    });
    work.triangles_seen += ContactWatch::kMostLooks - near.looks_left;
    return seen;
}

// Outside of all material, with the ball clear of it. Looked for in balls that double, as far as the looks suffice.
bool is_free(const Body& body, const Vec3& hand, const geometry::PosedSurface& surface, ContactWork& work) {
    const double radius_m = body.radius_m();
    const Box all = geometry::bounds(surface);
    const double everything = glm::length(glm::max(glm::abs(hand - all.lo), glm::abs(hand - all.hi)));
    for (double reach_m = radius_m;; reach_m *= 2.0) {
        const Seen seen = look_around(body, hand, reach_m, Vec3(0.0), surface, work);
        if (seen.distance_m <= radius_m) return false;
        // Where the looks did not suffice the hand counts as free, so that no unproved contact holds it.
        if (!seen.complete) return true;
        if (reach_m > everything) return seen.height_m >= 0.0;
        if (seen.distance_m <= reach_m) return seen.height_m >= 0.0;
    }
}

}  // namespace

void ContactWatch::look(WatchState& state, const Contact& contact, const geometry::PosedSurface& surface,
                        ContactWork& work) noexcept {
    if (state.ticks_to_look > 0) {
        --state.ticks_to_look;
        return;
    }
    state.ticks_to_look = kInterval - 1;
    const double radius_m = contact.radius_m;
    const Vec3 pull = contact.hand_m - contact.proxy_m;
    const double pull_m = glm::length(pull), step_m = kStep * radius_m;
    if (!(pull_m > 0.0)) return;
    const Body at_proxy(contact, contact.proxy_orientation);
    const Seen seen =
        look_around(at_proxy, contact.proxy_m, kTouching * radius_m, (step_m / pull_m) * pull, surface, work);
    const bool fits = seen.distance_m >= (1.0 - kDeep) * radius_m && seen.height_m >= 0.0;
    const bool in_the_way = seen.distance_m - seen.ahead_m > kInTheWay * step_m;
    const bool falls_behind = state.short_ticks >= kShort;
    const bool sound = fits && in_the_way;
    const bool doubtful = falls_behind || (seen.complete && !sound);
    if (doubtful && is_free(Body(contact, contact.hand_orientation), contact.hand_m, surface, work))
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
