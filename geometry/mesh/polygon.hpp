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
    fan,        // convex in its mean plane: a fan from corner 0
    ears,       // ear clipping in the mean plane
    blind_fan,  // flat, crossed, or above the corner limit: a fan from corner 0 that may fold over
};

struct SplitPolygon {
    PolygonSplit how = PolygonSplit::fan;
    // n - 2 triangles of corner numbers, in the polygon's direction.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

inline constexpr std::size_t kMaxEarCorners = 2048;

// Splits a polygon of n >= 3 finite points. The mean plane is Newell's (the normal of the vector area). O(n) for a
// convex polygon, O(n^2) for another of at most max_ear_corners corners.
[[nodiscard]] SplitPolygon split_polygon(std::span<const Vec3> corners_m, std::size_t max_ear_corners = kMaxEarCorners);

// Finds the triangulation of least area by dynamic programming (G. Barequet, M. Sharir, "Filling gaps in the boundary
// of a polyhedron", CAGD 12 (1995), 207-229, with the area as the weight). Returns n - 2 triangles of corner numbers in
// the loop's direction; nothing when every triangulation needs a diagonal (i, j) that is not allowed. Requires n >= 3.
// O(n^3) time, O(n^2) memory. The first of equally good ones wins.
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> least_area_triangulation(
    std::span<const Vec3> loop_m, const std::function<bool(std::size_t, std::size_t)>& allowed);

}  // namespace burin::geometry
