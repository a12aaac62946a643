// SPDX-License-Identifier: MIT
#include "haptics/god_object.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/local_surface_search.hpp"
#include "haptics/half_spaces.hpp"
#include "haptics/triangle_contact.hpp"

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
    [[nodiscard]] std::span<const HalfSpace> span() const { return {list.data(), count}; }
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
        result.complete = for_each_triangle_near(surface_, center - reach, center + reach, [&](std::uint32_t i) {
            if (far_from(i, center, reach)) return true;
            if (!count_test()) return false;
            const Triangle t = triangle(i);
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
        });
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
        const double length2 = glm::dot(motion, motion);
        result.complete = for_each_triangle_near(
            surface_, glm::min(center, end) - radius, glm::max(center, end) + radius, [&](std::uint32_t i) {
                const Vec3 to_middle = Vec3(surface_.search.spheres[i]) - center;
                const double along = std::clamp(glm::dot(to_middle, motion) / length2, 0.0, 1.0);
                if (far_from(i, center + along * motion, radius)) return true;
                if (!count_test()) return false;
                if (touches_already(planes, i)) return true;
                result.fraction = std::min(result.fraction, fraction_until_touch(center, motion, radius, triangle(i)));
                return true;
            });
        return result;
    }

    // The nearest triangle of all, by boxes that double until what they found must be it.
    Nearest nearest(const Vec3& center) {
        Nearest result;
        const SurfaceGrid& grid = surface_.search;
        const Vec3 far_corner =
            Vec3(grid.lo) + static_cast<double>(grid.cell_m) * Vec3(grid.cells[0], grid.cells[1], grid.cells[2]);
        const Vec3 span = glm::max(glm::abs(center - Vec3(grid.lo)), glm::abs(center - far_corner));
        const double everything = std::max({span.x, span.y, span.z});
        for (double reach = std::max(radius_, static_cast<double>(grid.cell_m));; reach *= 2.0) {
            for_each_triangle_near(surface_, center - reach, center + reach, [&](std::uint32_t i) {
                if (far_from(i, center, result.distance * (1.0 + kTie))) return true;
                if (!count_test()) return false;
                const Triangle t = triangle(i);
                const NearestOnTriangle on = nearest_on_triangle(center, t);
                const Vec3 off = center - on.point, normal = outward_normal(t);
                keep_nearest(result, {std::sqrt(glm::dot(off, off)), glm::dot(off, normal), on.point, normal});
                return true;
            });
            if (result.distance <= reach || reach >= everything) return result;
        }
    }

    [[nodiscard]] bool used_up() const { return work_.triangles_tested >= budget_.max_triangles_tested; }

private:
    [[nodiscard]] Triangle triangle(std::uint32_t i) const {
        const auto& v = surface_.triangles[i];
        return {Vec3(surface_.positions_m[v[0]]), Vec3(surface_.positions_m[v[1]]), Vec3(surface_.positions_m[v[2]])};
    }

    [[nodiscard]] bool far_from(std::uint32_t i, const Vec3& p, double reach) {
        ++work_.triangles_seen;
        const glm::vec4& sphere = surface_.search.spheres[i];
        const Vec3 off = p - Vec3(sphere);
        const double limit = reach + static_cast<double>(sphere.w);
        return glm::dot(off, off) > limit * limit;
    }

    [[nodiscard]] bool count_test() {
        if (used_up()) return false;
        ++work_.triangles_tested;
        return true;
    }

    static bool touches_already(const Planes& planes, std::uint32_t triangle) {
        for (std::uint32_t p = 0; p < planes.count; ++p)
            if (planes.list[p].triangle == triangle) return true;
        return false;
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

// Only where the ball around `center` that reaches the nearest triangle lies within what is known is "nearest" the
// truth.
bool inside_material(const Nearest& nearest, const Vec3& center, const LocalSurface& surface) {
    if (!(nearest.height < 0.0)) return false;
    const Vec3 off = center - (surface.center_object - surface.origin_object);
    return std::sqrt(glm::dot(off, off)) + nearest.distance <= surface.radius_m;
}

Vec3 put_outside(const Nearest& nearest, const Vec3& center, double radius) {
    const bool on_surface = nearest.distance < kTie * radius;
    const Vec3 way = on_surface ? nearest.normal : (nearest.point - center) / nearest.distance;
    return nearest.point + radius * way;
}

}  // namespace

ProxyResult move_proxy(const ProxyState& state, const Vec3& hip_object_m, double contact_radius_m,
                       const LocalSurface& surface, const ProxyBudget& budget) noexcept {
    ProxyResult result;
    result.next = {hip_object_m, surface.sequence, true};
    if (!surface.search.built || surface.search.listed == 0) return result;
    const double edge = static_cast<double>(surface.search.mean_edge_m);
    const double radius = std::max(contact_radius_m, kPointProbeOfEdge * edge);
    const double still = kStill * std::max(radius, 0.05 * edge);
    const Vec3 hip = hip_object_m - surface.origin_object;
    Vec3 center = state.placed ? state.position_object_m - surface.origin_object : hip;
    Mover mover(surface, radius, budget, result.work);
    Planes planes;

    auto touching = mover.touching(center, planes);
    const bool unsure = !state.placed || state.surface_sequence != surface.sequence;
    if (unsure && !(touching.nearest.distance < HUGE_VAL)) touching.nearest = mover.nearest(center);
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
    return result;
}

}  // namespace burin
