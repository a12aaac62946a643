// SPDX-License-Identifier: MIT
// Splits a polygon in space into triangles over its own corners: quickly, or with the least area.
// Used for faces of files (mesh_import) and for the filling of holes (mesh_repair). Deterministic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

enum class PolygonSplit : std::uint8_t {
    fan,       // convex: a fan from corner 0
    sweep,     // another simple polygon
    touching,  // touches itself; the triangles do not overlap
    crossing,  // crosses itself or has no area: triangles overlap or face the other way
};

struct SplitPolygon {
    PolygonSplit how = PolygonSplit::fan;
    // n - 2 triangles of corner numbers, in the polygon's direction. Every edge of the polygon is an edge of one.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Splits a polygon of n >= 3 finite points (flat_polygon.hpp). It is seen along the axis that its normal is nearest to,
// in which no coordinate is rounded, and otherwise in its mean plane: that of the vector area (Newell 1972). Corners
// need not lie in one plane, as long as the polygon is simple as seen in either of them. The triangles of a simple
// polygon have positive areas there; those at a corner that repeats the place of the one before have none. O(n) for a
// convex polygon, O(n log n) for another simple one.
[[nodiscard]] SplitPolygon split_polygon(std::span<const Vec3> corners_m);

// Finds the triangulation of least area by dynamic programming (G. Barequet, M. Sharir, "Filling gaps in the boundary
// of a polyhedron", CAGD 12 (1995), 207-229, with the area as the weight). Returns n - 2 triangles of corner numbers in
// the loop's direction; nothing when every triangulation needs a diagonal (i, j) that is not allowed. Requires n >= 3.
// O(n^3) time, O(n^2) memory. The first of equally good ones wins.
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> least_area_triangulation(
    std::span<const Vec3> loop_m, const std::function<bool(std::size_t, std::size_t)>& allowed);

}  // namespace burin::geometry
