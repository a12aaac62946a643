// SPDX-License-Identifier: MIT
// How far a convex piece of a tool is from a triangle: a plane between the two.
//
// Found by the distance algorithm of Gilbert, Johnson and Keerthi 1988 on the difference of the two sets. It ends with
// a direction and the gap between both along it, which is a proved lower bound of their distance: a piece that stays
// beyond the plane cannot enter the triangle, because both are convex. Frame: the tool's axes, metres, any origin.
// Pure; + - * / and sqrt only; no heap, lock, throw.
#pragma once

#include <cstdint>

#include "geometry/mesh/triangle.hpp"
#include "haptics/contact/tool_shape.hpp"

namespace burin::haptics {

struct Separation {
    bool overlaps = false;       // no plane was found between them; the rest says nothing
    double gap_m = 0.0;          // along the normal; with exactness, the distance
    bool exact = false;          // false: the search ended as soon as the gap was beyond what matters
    Vec3 normal{0.0};            // unit, from the triangle to the piece
    Vec3 on_triangle{0.0};       // the place of the triangle that is nearest to the piece
    std::uint32_t supports = 0;  // corners of the piece searched, so many times
};

struct SeparationQuery {
    Vec3 at{0.0};              // where the piece's origin is
    Vec3 guess{0.0};           // a direction from the triangle to the piece, of any length but 0
    double matters_m = 0.0;    // a gap beyond it need not be exact
    double tolerance_m = 0.0;  // of the gap
};

// The height of the piece's lowest place above the plane through the origin with this normal.
[[nodiscard]] double lowest(const ToolShape& shape, const ConvexPiece& piece, const Vec3& normal) noexcept;

// A place of the piece that is so low.
[[nodiscard]] Vec3 lowest_place(const ToolShape& shape, const ConvexPiece& piece, const Vec3& normal) noexcept;

[[nodiscard]] Separation separation(const ToolShape& shape, const ConvexPiece& piece, const geometry::Triangle& t,
                                    const SeparationQuery& query) noexcept;

}  // namespace burin::haptics
