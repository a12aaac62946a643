// SPDX-License-Identifier: MIT
// The triangulation of least area over the vertices of a loop in space, by dynamic programming.
// Source: G. Barequet, M. Sharir, "Filling gaps in the boundary of a polyhedron", CAGD 12 (1995), 207-229, with the
// area as the weight. Internal to geometry/.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin::geometry {

// Returns n - 2 triangles of corner numbers in the loop's direction; nothing when every triangulation needs a diagonal
// (i, j) that is not allowed. Requires n >= 3. O(n^3) time, O(n^2) memory. Deterministic: the first of equally good
// ones wins.
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>> least_area_triangulation(
    std::span<const Vec3> loop_m, const std::function<bool(std::size_t, std::size_t)>& allowed);

}  // namespace burin::geometry
