// SPDX-License-Identifier: MIT
// Splits a tool that moves straight (cylinder, cone, bull-nose or box) into convex pieces, in lattice units.
//
// A swept bull-nose has no closed form along a general direction (even at rest, its section with a ray is a quartic).
// Its corner, a quarter of a circle with radius c, is cut into 2^k slices of cones whose edges lie on the circle. The
// surface then lies inside the true one by at most c (1 - cos(a / 2)), a = pi / 2^(k + 1); k is the least for which
// this stays within a quarter of the sweep's tolerance. Each slice is swept in closed form and takes its normals from
// the true corner.
#pragma once

#include <variant>
#include <vector>

#include "compute/tools/convex_sweep.hpp"
#include "compute/tools/turning_sweep.hpp"

namespace burin::compute {

using ConvexPiece = std::variant<FrustumSweep, BoxSweep>;

// The pieces of a sweep, move after move. Those of one move are stacked along the tool's axis, from its tip on.
struct ConvexPieces {
    std::vector<ConvexPiece> pieces;
    std::size_t a_move = 1;  // pieces of each move
};

[[nodiscard]] inline SweepSpan span_of(const ConvexPiece& piece, int axis, double ray_u, double ray_v) {
    return std::visit([&](const auto& p) { return p.span(axis, ray_u, ray_v); }, piece);
}
[[nodiscard]] inline Box bounds_of(const ConvexPiece& piece) {
    return std::visit([](const auto& p) { return p.bounds(); }, piece);
}

// Return the tool's extent in the tool frame, in lattice units. Fail on invalid sizes.
[[nodiscard]] Result<Extent> extent_of(const CylinderTool& tool, double unit_m);
[[nodiscard]] Result<Extent> extent_of(const ConeTool& tool, double unit_m);
[[nodiscard]] Result<Extent> extent_of(const BullNoseTool& tool, double unit_m);
[[nodiscard]] Result<Extent> extent_of(const BoxTool& tool, double unit_m);

// Append the pieces of one move. `tolerance` is in lattice units; the tool must be one that extent_of accepts.
void append_pieces(const CylinderTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);
void append_pieces(const ConeTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);
void append_pieces(const BullNoseTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);
void append_pieces(const BoxTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);

}  // namespace burin::compute
