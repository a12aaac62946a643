// SPDX-License-Identifier: MIT
// Bounds of all triangles of a tile, by which a search passes it by: their longest edge, and a plane that none crosses.
// Pure; the same bits on every machine.
#pragma once

#include <vector>

#include "base/space.hpp"
#include "geometry/contact/surface_tile.hpp"

namespace burin::compute {

struct TileBounds {
    float longest_edge_m = 0.0f;
    geometry::TriangleSlab slab;
};

// Equals geometry::slab_around and the longest edge of each triangle. Uses `places` as scratch memory.
[[nodiscard]] TileBounds bounds_of(const geometry::SurfaceTile& tile, std::vector<Vec3>& places);

}  // namespace burin::compute
