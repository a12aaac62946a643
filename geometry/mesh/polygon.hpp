// SPDX-License-Identifier: MIT
// Splits a polygon in space into triangles over its own corners.
// Used for faces of files (mesh_import) and for the filling of holes (mesh_repair).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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
// convex polygon, O(n^2) for another of at most max_ear_corners corners. Deterministic.
[[nodiscard]] SplitPolygon split_polygon(std::span<const Vec3> corners_m, std::size_t max_ear_corners = kMaxEarCorners);

}  // namespace burin::geometry
