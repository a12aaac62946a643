// SPDX-License-Identifier: MIT
// What a search needs to know of all triangles of a tile at once: their longest edge, and a plane that they lie behind.
// Pure; the same bits on every machine.
#pragma once

#include <vector>

#include "geometry/contact/surface_tile.hpp"

namespace burin::compute {

struct TileBounds {
    float longest_edge_m = 0.0f;
    geometry::TriangleSlab slab;
};

// Equals geometry::slab_around and the longest edge of each triangle. Uses `heights` as scratch memory.
[[nodiscard]] TileBounds bounds_of(const geometry::SurfaceTile& tile, std::vector<double>& heights);

}  // namespace burin::compute
