// SPDX-License-Identifier: MIT
// Tells whether two triangles of a mesh meet where they should not: in any point other than the vertices and the edge
// that they share by index. Touching counts, and so do neighbours in one plane that are folded onto each other, two
// triangles with the same three vertices, and distinct vertices at one position. Decided without rounding
// (exact_sign.hpp).
// A triangle without area counts as the segment or the point that it is. Pure functions; 50 ns for most neighbours.
#pragma once

#include <span>

#include "geometry/mesh/edge_table.hpp"

namespace burin::geometry {

// Tests two triangles by index. Neither triple may name a vertex twice.
[[nodiscard]] bool meet_beyond_shared(std::span<const Vec3> positions, const VertexTriple& first,
                                      const VertexTriple& second);

// Tells whether the triangles have any common point.
[[nodiscard]] bool triangles_meet(const std::array<Vec3, 3>& first, const std::array<Vec3, 3>& second);

}  // namespace burin::geometry
