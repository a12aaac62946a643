// SPDX-License-Identifier: MIT
// The convex pieces of a tool on its way: cylinder, cone, bull-nose and box, moved straight, in lattice units.
//
// A bull-nose has no closed form along a general direction (its section with a ray is a quartic already at rest). Its corner,
// a quarter of a circle with radius c, is cut into 2^k slices of cones whose edges lie on the circle: the surface is inside by
// at most c (1 - cos(a / 2)), a = pi / 2^(k + 1), for which the least k is taken that stays within a quarter of the sweep's
// tolerance. Each slice is swept in closed form, and takes its normals from the true corner.
#pragma once

#include <variant>
#include <vector>

#include "compute/convex_sweep.hpp"
#include "compute/turning_sweep.hpp"

namespace burin {

using ConvexPiece = std::variant<FrustumSweep, BoxSweep>;

[[nodiscard]] inline SweepSpan span_of(const ConvexPiece& piece, int axis, double ray_u, double ray_v) {
    return std::visit([&](const auto& p) { return p.span(axis, ray_u, ray_v); }, piece);
}
[[nodiscard]] inline Box bounds_of(const ConvexPiece& piece) {
    return std::visit([](const auto& p) { return p.bounds(); }, piece);
}

// Tool frame, lattice units. Fails on sizes that cannot be.
[[nodiscard]] Result<Extent> extent_of(const CylinderTool& tool, double unit_m);
[[nodiscard]] Result<Extent> extent_of(const ConeTool& tool, double unit_m);
[[nodiscard]] Result<Extent> extent_of(const BullNoseTool& tool, double unit_m);
[[nodiscard]] Result<Extent> extent_of(const BoxTool& tool, double unit_m);

// Appends the pieces of one move. tolerance in lattice units; the tool must be one that extent_of accepts.
void append_pieces(const CylinderTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);
void append_pieces(const ConeTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);
void append_pieces(const BullNoseTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);
void append_pieces(const BoxTool& tool, const StraightMove& move, double unit_m, double tolerance,
                   std::vector<ConvexPiece>& pieces);

}  // namespace burin
