// SPDX-License-Identifier: MIT
// Splits a polygon in space into triangles over its own corners.
// Used for faces of files (mesh_import) and for the filling of holes (mesh_mend).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin {

enum class PolygonSplit : std::uint8_t {
    fan,        // convex in its mean plane: a fan from corner 0
    ears,       // ears cut in the mean plane
    blind_fan,  // flat, crossed, or above the corner limit: a fan from corner 0 that may fold over
};

struct SplitPolygon {
    PolygonSplit how = PolygonSplit::fan;
    std::vector<std::array<std::uint32_t, 3>>
        triangles;  // n - 2 of them, numbers of corners, in the polygon's direction
};

inline constexpr std::size_t kMaxEarCorners = 2048;

// n >= 3 finite points. The mean plane is Newell's (the normal of the vector area). O(n) for a convex polygon,
// O(n^2) for another of at most max_ear_corners corners. Deterministic.
[[nodiscard]] SplitPolygon split_polygon(std::span<const Vec3> corners_m, std::size_t max_ear_corners = kMaxEarCorners);

}  // namespace burin
