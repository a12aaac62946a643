// SPDX-License-Identifier: MIT
#include "haptics/contact/god_object.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/local_surface_search.hpp"
#include "haptics/contact/half_spaces.hpp"
#include "haptics/contact/triangle_contact.hpp"

namespace burin {
namespace {

// All as fractions of the ball's radius; see the header.
constexpr double kTouch = 1e-3;
constexpr double kPlane = 1e-9;  // rounding of plane offsets, far below anything felt
constexpr double kTie = 1e-6;    // two triangles share their nearest point: an edge or a corner
constexpr double kPointProbeOfEdge = 1.0 / 500.0;
// The proxy stands still when it moves less than this fraction of the radius, or of a twentieth of an edge if that is
// more.
constexpr double kStill = 1e-5;

// Pushing out the thousandth of R that edges may sink in can go back and forth between facets. After these steps the
// ball is only kept from going deeper, so that each step brings it nearer to the HIP and the steps come to an end.
constexpr std::uint32_t kPushingSteps = 3;

constexpr std::uint32_t kMostPlanes = 512;  // 20 kB of stack; a ball lying in its own groove touches about 100 facets

struct Planes {
    std::array<HalfSpace, kMostPlanes> list;
    std::uint32_t count = 0;
    std::array<std::uint32_t, kMostPlanes> triangles;  // those of the list, in rising order
    [[nodiscard]] std::span<const HalfSpace> span() const { return {list.data(), count}; }
    [[nodiscard]] bool has(std::uint32_t triangle) const {
        return std::binary_search(triangles.begin(), triangles.begin() + count, triangle);
    }
    void sort_triangles() {
        for (std::uint32_t i = 0; i < count; ++i) triangles[i] = list[i].triangle;
        const auto end = triangles.begin() + count;
        if (!std::is_sorted(triangles.begin(), end)) std::sort(triangles.begin(), end);  // tiles come sorted
    }
};

struct Nearest {
    double distance = HUGE_VAL;
    double height = 0.0;  // above the triangle's plane; negative: behind it
    Vec3 point{0.0};
    Vec3 normal{0.0};
};

// One tick's worth of proxy motion. Everything is relative to the surface's origin.
class Mover {
public:
    Mover(const LocalSurface& surface, double radius, const ProxyBudget& budget, ProxyWork& work)
        : surface_(surface), radius_(radius), budget_(budget), work_(work) {}

    struct Touching {
        Nearest nearest;  // of all triangles within reach, whichever side they turn
        bool complete = true;
    };

    // Fills planes with the half-spaces, relative to `center`, of the triangles that the ball touches from outside.
    Touching touching(const Vec3& center, Planes& planes) {
        Touching result;
        planes.count = 0;
        const double reach = radius_ * (1.0 + kTouch);
        Near near{center, center, reach};
        const auto visit = [&](std::uint32_t i, const Triangle& t) {
            if (!count_test()) return false;
            const NearestOnTriangle on = nearest_on_triangle(center, t);
            const Vec3 off = center - on.point;
            if (glm::dot(off, off) > reach * reach) return true;
            const double distance = std::sqrt(glm::dot(off, off));
            const Vec3 normal = outward_normal(t);
            const double height = glm::dot(off, normal);
            keep_nearest(result.nearest, {distance, height, on.point, normal});
            if (height < 0.0) return true;
            if (planes.count == kMostPlanes) return false;
            const bool flat = on.on_face || distance < kTie * radius_;
            planes.list[planes.count++] = {flat ? normal : off / distance,
                                           radius_ * (flat ? 1.0 : 1.0 - kTouch) - distance, i};
            return true;
        };
        result.complete = search(near, visit);
        planes.sort_triangles();
        return result;
    }

    struct Sweep {
        double fraction = 1.0;
        bool complete = true;
    };

    // How far the ball may go, all triangles considered but those that touch already.
    Sweep sweep(const Vec3& center, const Vec3& motion, const Planes& planes) {
        Sweep result;
        const double radius = radius_ * (1.0 - 2.0 * kTouch);
        const Vec3 end = center + motion;
        // What is near the box around a long way need not be near the way.
        const bool is_long = glm::dot(motion, motion) > 0.25 * radius * radius;
        const auto visit = [&](std::uint32_t i, const Triangle& t) {
            if (planes.has(i) || (is_long && beside(t, center, motion, radius))) return true;
            if (!count_test()) return false;
            result.fraction = std::min(result.fraction, fraction_until_touch(center, motion, radius, t));
            return true;
        };
        Near near{glm::min(center, end), glm::max(center, end), radius};
        result.complete = search(near, visit);
        return result;
    }

    // The nearest triangle of all, by boxes that double until what they found must be it. Of those that are farther than
    // `most` any or none; none too when the work is used up.
    Nearest nearest(const Vec3& center, double most) {
        Nearest result;
        Near near{center, center};
        const auto visit = [&](std::uint32_t, const Triangle& t) {
            if (beside(t, center, Vec3(0.0), result.distance * (1.0 + kTie))) return true;
            if (!count_test()) return false;
            const NearestOnTriangle on = nearest_on_triangle(center, t);
            const Vec3 off = center - on.point, normal = outward_normal(t);
            keep_nearest(result, {std::sqrt(glm::dot(off, off)), glm::dot(off, normal), on.point, normal});
            near.reach_m = std::min(near.reach_m, result.distance * (1.0 + kTie));
            return true;
        };
        const Box all = bounds(surface_);
        const Vec3 span = glm::max(glm::abs(center - all.lo), glm::abs(center - all.hi));
        const double everything = std::min(most, std::max({span.x, span.y, span.z}));
        for (double reach = std::max(radius_, 2.0 * surface_.mean_edge_m());; reach *= 2.0) {
            near.reach_m = reach;
            if (!search(near, visit)) return {};
            if (result.distance <= reach || reach >= everything) return result;
        }
    }

private:
    // visit may make near.reach_m smaller.
    template <typename Visit>
    bool search(Near& near, Visit&& visit) {
        const std::uint32_t looks = budget_.max_triangles_seen - work_.triangles_seen;
        near.looks_left = looks;
        const bool complete = for_each_triangle_near(surface_, near, visit);
        work_.triangles_seen += looks - near.looks_left;
        return complete;
    }

    // Whether the ball around the triangle's box is farther than `reach` from all of the way: a cheap look before a test.
    static bool beside(const Triangle& t, const Vec3& start, const Vec3& motion, double reach) {
        const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
        const Vec3 middle = 0.5 * (lo + hi), to_middle = middle - start;
        const double length2 = glm::dot(motion, motion);
        const double along = length2 > 0.0 ? std::clamp(glm::dot(to_middle, motion) / length2, 0.0, 1.0) : 0.0;
        const Vec3 off = to_middle - along * motion;
        const double limit = reach + 0.5 * glm::length(hi - lo) * (1.0 + 1e-9);
        return glm::dot(off, off) > limit * limit;
    }

    [[nodiscard]] bool count_test() {
        if (work_.triangles_tested >= budget_.max_triangles_tested) return false;
        ++work_.triangles_tested;
        return true;
    }

    // Of triangles that share the nearest point the one that is looked at most squarely tells inside from outside: at a
    // sharp edge the other may be seen from its back although the point is outside.
    void keep_nearest(Nearest& best, const Nearest& other) const {
        const double tie = kTie * radius_;
        if (other.distance < best.distance - tie ||
            (other.distance <= best.distance + tie && std::abs(other.height) > std::abs(best.height)))
            best = other;
    }

    const LocalSurface& surface_;
    double radius_;
    ProxyBudget budget_;
    ProxyWork& work_;
};

// With the ball pushed out where it sinks in; if that is not wanted or there is no room for it, at least no deeper.
NearestInside goal_in(Planes& planes, const Vec3& goal, double radius, bool push_out, ProxyWork& work) {
    if (push_out) {
        ++work.plane_solves;
        const NearestInside best = nearest_inside(planes.span(), goal, kPlane * radius);
        if (best.found) return best;
    }
    ++work.plane_solves;
    for (std::uint32_t i = 0; i < planes.count; ++i) planes.list[i].offset = std::min(planes.list[i].offset, 0.0);
    return nearest_inside(planes.span(), goal, kPlane * radius);
}

void note_active(ProxyResult& result, const Planes& planes, const NearestInside& goal) {
    result.constraints = goal.bearing_count;
    if (goal.bearing_count == 0) return;
    std::uint32_t heaviest = 0;
    for (std::uint32_t i = 1; i < goal.bearing_count; ++i)
        if (goal.weights[i] > goal.weights[heaviest]) heaviest = i;
    result.active_triangle = planes.list[goal.bearing[heaviest]].triangle;
}

void note_normal(ProxyResult& result, const Vec3& hip_object_m) {
    const Vec3 off = result.next.position_object_m - hip_object_m;
    const double distance = std::sqrt(glm::dot(off, off));
    if (distance > 0.0) result.normal_object = off / distance;
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

}  // namespace

ProxyResult move_proxy(const ProxyState& state, const Vec3& hip_object_m, const ProxySettings& settings,
                       const LocalSurface& surface, const ProxyBudget& budget) noexcept {
    ProxyResult result;
    result.next = {hip_object_m, surface.sequence, true};
    const double edge = surface.mean_edge_m();
    if (!(edge > 0.0)) return result;  // nothing there to touch
    const double radius = std::max(settings.contact_radius_m, kPointProbeOfEdge * edge);
    const double still = kStill * std::max(radius, 0.05 * edge);
    const Vec3 hip = hip_object_m - surface.origin_object;
    Vec3 center = state.placed ? state.position_object_m - surface.origin_object : hip;
    Mover mover(surface, radius, budget, result.work);
    Planes planes;

    auto touching = mover.touching(center, planes);
    const bool unsure = !state.placed || state.surface_sequence != surface.sequence;
    if (unsure && !(touching.nearest.distance < HUGE_VAL))
        touching.nearest = mover.nearest(center, known_around(center, surface));
    if (inside_material(touching.nearest, center, surface)) {
        center = put_outside(touching.nearest, center, radius);
        result.pushed_out = true;
        touching = mover.touching(center, planes);
    }
    for (;; touching = mover.touching(center, planes)) {
        ++result.work.steps;
        const NearestInside goal =
            goal_in(planes, hip - center, radius, result.work.steps <= kPushingSteps, result.work);
        if (!touching.complete || !goal.found) break;
        note_active(result, planes, goal);
        if (glm::dot(goal.point, goal.point) <= still * still && goal.bearing_count > 0) {
            result.next.position_object_m = surface.origin_object + (center + goal.point);
            note_normal(result, hip_object_m);
            return result;
        }
        if (goal.point == Vec3(0.0)) return result;  // only in free space: the proxy already is at the HIP
        const auto sweep = mover.sweep(center, goal.point, planes);
        if (!sweep.complete) break;
        if (sweep.fraction >= 1.0 && goal.bearing_count == 0) return result;  // free: the proxy is the HIP, exactly
        center += sweep.fraction * goal.point;
        if (result.work.steps >= budget.max_steps) break;
    }
    result.work_limited = true;
    result.next.position_object_m = surface.origin_object + center;
    note_normal(result, hip_object_m);
    return result;
}

}  // namespace burin
