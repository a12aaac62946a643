// SPDX-License-Identifier: MIT
// The shape that touches, where it is no ball: convex pieces with rounded edges.
//
// A piece is the convex hull of its corners, or of circles about the tool's axis, +Y, and everything within rounding_m
// of that hull. The hulls lie inside the tool by more than that, so that what touches is the tool less the clearance
// that a ball has too, with its edges rounded (toolbox/felt_tool.hpp makes it and says by how much it differs). A tool
// of one piece is felt as convex. A hull of more than kMostCorners is thinned evenly by its maker, whose `differs_m`
// says what that takes; of the kinds of tool only a mesh can have so many.
// Frame: tool, metres of the object frame. Plain data of fixed size.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/space.hpp"

namespace burin::haptics {

struct ConvexPiece {
    std::uint32_t first = 0, count = 0;  // of the shape's corners
    // The corners are circles about the axis: x is the radius, y the height, z is 0.
    bool turned = false;
};

// One side of a shape of one piece: nothing of its hull is farther along the normal than offset_m. Of a turned piece
// the normal is (across the axis, along it, 0), and the side goes all around.
struct ToolSide {
    Vec3 normal{0.0, 1.0, 0.0};
    double offset_m = 0.0;
};

struct ToolShape {
    static constexpr std::uint32_t kMostPieces = 16, kMostCorners = 384, kMostSides = 16;

    std::uint32_t piece_count = 0;  // 0: there is no shape, and the probe's balls touch
    double rounding_m = 0.0;
    double size_m = 0.0;   // the tool's least width
    Box bounds{};          // of the hulls with their rounding
    double reach_m = 0.0;  // radius of a ball about the tool's origin that contains it
    Vec3 inside_m{0.0};    // a place inside it, far from its surface
    std::array<ConvexPiece, kMostPieces> pieces{};
    std::array<Vec3, kMostCorners> corners{};
    // Most of what is near is told apart by one of these, without a search. They may be left out.
    std::uint32_t side_count = 0;
    std::array<ToolSide, kMostSides> sides{};

    [[nodiscard]] bool touches() const noexcept { return piece_count > 0; }
    [[nodiscard]] std::span<const Vec3> corners_of(const ConvexPiece& piece) const noexcept {
        return std::span(corners).subspan(piece.first, piece.count);
    }
};

}  // namespace burin::haptics
