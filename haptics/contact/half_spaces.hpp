// SPDX-License-Identifier: MIT
// The point of an intersection of half-spaces that is nearest to a goal: the god-object's next goal.
//
// Exact (no penalty, no relaxation): at most three planes bear the answer, each with a non-negative weight, which is
// Zilles and Salisbury's rule for the active planes. Found by adding the most violated plane to the bearing planes and
// keeping the best subset; the distance to the goal grows with every exchange, so the search ends. Pure, no heap, no
// throw.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/space.hpp"

namespace burin::haptics {

struct HalfSpace {
    Vec3 normal{0.0};     // unit
    double offset = 0.0;  // inside: dot(normal, x) >= offset
};

struct NearestInside {
    bool found = false;  // false: no common point, or none found within the bound on exchanges
    Vec3 point{0.0};
    std::array<std::uint32_t, 3> bearing{};  // indices of the planes that bear the point
    std::array<double, 3> weights{};         // point = goal + sum of weight * normal
    std::uint32_t bearing_count = 0;
    std::uint32_t exchanges = 0;
};

// tolerance: how far outside a half-space still counts as inside (metres, or whatever the offsets are in).
[[nodiscard]] NearestInside nearest_inside(std::span<const HalfSpace> spaces, const Vec3& goal,
                                           double tolerance) noexcept;

// The share of a way from the origin up to the first plane that it would cross; at most 1, at least 0.
[[nodiscard]] double share_to_first(std::span<const HalfSpace> spaces, const Vec3& way) noexcept;

// The way from the origin out of the planes that it lies behind by more than `least`: out of the one that it is the
// deepest behind, again and again, a bounded number of times. Not the shortest, but found where nearest_inside() finds
// nothing.
[[nodiscard]] Vec3 way_out(std::span<const HalfSpace> spaces, double least) noexcept;

// A way that crosses no plane: the goal's own, or along the plane that it crosses most steeply, or along the edge of
// that plane and of the one that this way crosses most steeply; the first of these that is longer than `least`. Where
// nearest_inside() finds nothing among nearly parallel planes, it still gets on.
struct WayAlong {
    bool found = false;
    bool along_planes = false;
    Vec3 step{0.0};   // up to the first plane
    Vec3 whole{0.0};  // as if there were no further plane
};
[[nodiscard]] WayAlong way_along(std::span<const HalfSpace> spaces, const Vec3& goal, double least) noexcept;

}  // namespace burin::haptics
