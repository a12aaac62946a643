// SPDX-License-Identifier: MIT
// Splits a polygon in a plane into triangles over its own corners: a simple one by a sweep, one that crosses itself by
// cutting ears.
//
// Every decision is the sign of an exact determinant (exact_sign.hpp) on the coordinates as they are given, so that a
// corner on a line, a thin wedge or a place far from the origin is not special. The sweep finds out on its way whether
// the polygon is simple, and fails on no simple polygon. No library was taken: CGAL's triangulations are exact, but
// under the GPL and many headers for one function; poly2tri and earcut decide in rounded numbers.
//
// Corners are numbered from 0 and run in either direction; triangles run in the polygon's own. Every edge of the
// polygon is an edge of one triangle. Deterministic; any thread; allocates.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

using CornerTriple = std::array<std::uint32_t, 3>;

enum class SelfContact : std::uint8_t {
    none,   // simple
    touch,  // two corners or a corner and an edge share a place, or edges overlap; whether edges cross may be unknown
    cross,  // edges cross, or the inside is covered twice
};

struct SweptPolygon {
    SelfContact contact = SelfContact::none;  // the worst that the sweep has met
    // n - 2 of positive area; none when the polygon crosses itself, or touches itself so that the sweep finds no order.
    std::vector<CornerTriple> triangles;
};

// Splits a polygon of n >= 3 corners that is simple (a corner of 180 degrees is allowed) or only touches itself, as an
// outline does with a hole that a slit of no width joins to it. The triangles: S. Hertel, K. Mehlhorn, "Fast
// triangulation of simple polygons", FCT 1983; the contacts: M. Shamos, D. Hoey, "Geometric intersection problems",
// FOCS 1976. O(n log n) time: 20,000 corners take some 10 ms.
[[nodiscard]] SweptPolygon sweep_polygon(std::span<const Vec2> corners);

struct ClippedPolygon {
    std::vector<CornerTriple> triangles;  // n - 2
    // A triangle may overlap others or face the other way: no ear was left, or the work became too much. Otherwise all
    // areas are positive or zero, and add up to the polygon's.
    bool folded = false;
};

// Splits any polygon of n >= 3 corners that does not run clockwise. At most some 4,000 steps a corner.
[[nodiscard]] ClippedPolygon clip_ears(std::span<const Vec2> corners);

}  // namespace burin::geometry
