// SPDX-License-Identifier: MIT
#include "haptics/contact/half_spaces.hpp"

#include <cmath>

namespace burin::haptics {
namespace {

constexpr std::uint32_t kMostExchanges = 48;
constexpr int kMostWaysOut = 16;

// A candidate set of one to three active planes.
struct Bearing {
    std::array<std::uint32_t, 3> planes{};
    std::uint32_t count = 0;
};

struct Projection {
    bool valid = false;
    Vec3 point{0.0};
    std::array<double, 3> weights{};
};

// The point on the planes' intersection that is nearest to the goal. Not valid for nearly parallel planes.
Projection project(std::span<const HalfSpace> spaces, const Bearing& set, const Vec3& goal) {
    Projection result;
    const auto plane = [&](std::size_t i) -> const HalfSpace& { return spaces[set.planes[i]]; };
    const auto lack = [&](std::size_t i) { return plane(i).offset - glm::dot(plane(i).normal, goal); };
    const Vec3& n0 = plane(0).normal;
    if (set.count == 1) {
        result.weights[0] = lack(0);
    } else if (set.count == 2) {
        const Vec3& n1 = plane(1).normal;
        const Vec3 line = glm::cross(n0, n1);
        const double sine2 = glm::dot(line, line);
        if (sine2 < 1e-14) return result;
        const double cosine = glm::dot(n0, n1);
        result.weights[0] = (lack(0) - cosine * lack(1)) / sine2;
        result.weights[1] = (lack(1) - cosine * lack(0)) / sine2;
    } else {
        const Vec3 &n1 = plane(1).normal, &n2 = plane(2).normal;
        const Vec3 c12 = glm::cross(n1, n2), c20 = glm::cross(n2, n0), c01 = glm::cross(n0, n1);
        const double volume = glm::dot(n0, c12);
        if (std::abs(volume) < 1e-9) return result;
        const Vec3 step = (c12 * lack(0) + c20 * lack(1) + c01 * lack(2)) / volume;
        result.weights = {glm::dot(step, c12) / volume, glm::dot(step, c20) / volume, glm::dot(step, c01) / volume};
        result.point = goal + step;
        result.valid = true;
        return result;
    }
    result.point = goal;
    for (std::uint32_t i = 0; i < set.count; ++i) result.point += result.weights[i] * plane(i).normal;
    result.valid = true;
    return result;
}

double lack_at(const HalfSpace& space, const Vec3& x) { return space.offset - glm::dot(space.normal, x); }

// Finds the optimum over the old bearing planes and the added one. The added plane certainly bears, since the old
// optimum violates it; so the subsets are: the added plane alone, with each old one, with each pair. A point that
// satisfies all planes with no negative weight is the unique optimum, so the first found is returned.
NearestInside exchange(std::span<const HalfSpace> spaces, const NearestInside& old, std::uint32_t added,
                       const Vec3& goal, double tolerance) {
    constexpr std::array<std::array<std::uint32_t, 2>, 7> kSubsets{
        {{9, 9}, {0, 9}, {1, 9}, {2, 9}, {0, 1}, {0, 2}, {1, 2}}};  // 9: none
    NearestInside result;
    for (const auto& subset : kSubsets) {
        Bearing set{{added}, 1};
        bool exists = true;
        for (const std::uint32_t i : subset) {
            if (i == 9) continue;
            if (i >= old.bearing_count)
                exists = false;
            else
                set.planes[set.count++] = old.bearing[i];
        }
        if (!exists) continue;
        const Projection p = project(spaces, set, goal);
        bool optimal = p.valid;
        for (std::uint32_t i = 0; optimal && i < set.count; ++i) optimal = p.weights[i] >= 0.0;
        for (std::uint32_t i = 0; optimal && i < old.bearing_count; ++i)
            optimal = lack_at(spaces[old.bearing[i]], p.point) <= tolerance;
        if (!optimal) continue;
        result.found = true;
        result.point = p.point;
        result.bearing = set.planes;
        result.weights = p.weights;
        result.bearing_count = set.count;
        return result;
    }
    return result;
}

// Shortcut for a single plane, the most common case.
NearestInside on_one(const HalfSpace& space, const Vec3& goal, double tolerance) {
    NearestInside result;
    result.found = true;
    result.point = goal;
    const double lack = lack_at(space, goal);
    if (!(lack > tolerance)) return result;
    result.point += lack * space.normal;
    result.weights[0] = lack;
    result.bearing_count = 1;
    result.exchanges = 1;
    return result;
}

}  // namespace

NearestInside nearest_inside(std::span<const HalfSpace> spaces, const Vec3& goal, double tolerance) noexcept {
    NearestInside best;
    best.found = true;
    best.point = goal;
    if (spaces.size() == 1) return on_one(spaces[0], goal, tolerance);
    for (std::uint32_t exchanges = 0; exchanges <= kMostExchanges; ++exchanges) {
        std::uint32_t worst = 0;
        double worst_lack = tolerance;
        for (std::uint32_t i = 0; i < spaces.size(); ++i) {
            const double lack = lack_at(spaces[i], best.point);
            if (lack > worst_lack) worst_lack = lack, worst = i;
        }
        best.exchanges = exchanges;
        if (!(worst_lack > tolerance)) return best;
        best = exchange(spaces, best, worst, goal, tolerance);
        if (!best.found) break;
    }
    best.found = false;
    return best;
}

double share_to_first(std::span<const HalfSpace> spaces, const Vec3& way) noexcept {
    double share = 1.0;
    for (const HalfSpace& plane : spaces) {
        const double sinking = glm::dot(plane.normal, way);
        if (sinking < 0.0) share = std::min(share, plane.offset / sinking);
    }
    return std::max(share, 0.0);
}

Vec3 way_out(std::span<const HalfSpace> spaces, double least) noexcept {
    Vec3 at(0.0);
    for (int i = 0; i < kMostWaysOut; ++i) {
        const HalfSpace* worst = nullptr;
        double lack = least;
        for (const HalfSpace& plane : spaces)
            if (const double here = lack_at(plane, at); here > lack) lack = here, worst = &plane;
        if (worst == nullptr) break;
        at += lack * worst->normal;
    }
    return at;
}

WayAlong way_along(std::span<const HalfSpace> spaces, const Vec3& goal, double least) noexcept {
    const auto most_opposed = [&](const Vec3& way) {
        Vec3 normal(0.0);
        double most = 0.0;
        for (const HalfSpace& plane : spaces) {
            const double sinking = glm::dot(plane.normal, way);
            if (sinking < most) most = sinking, normal = plane.normal;
        }
        return normal;
    };
    Vec3 way = goal, first(0.0);
    for (int planes = 0; planes < 3; ++planes) {
        const double share = share_to_first(spaces, way);
        if (share * glm::length(way) > least) return {true, planes > 0, share * way, way};
        const Vec3 normal = most_opposed(way);
        if (normal == Vec3(0.0)) break;
        if (planes == 0) {
            first = normal;
            way -= glm::dot(way, normal) * normal;
        } else {
            const Vec3 edge = glm::cross(first, normal);
            const double length2 = glm::dot(edge, edge);
            if (!(length2 > 0.0)) break;
            way = (glm::dot(goal, edge) / length2) * edge;
        }
    }
    return {};
}

}  // namespace burin::haptics
