// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "compute/mesher/surface.hpp"

namespace burin::compute {
namespace {

// Returns a box around the triangles of a tile, given the tile's position in the grid; metres from the lattice's
// origin.
Box reach_of_tile(const std::array<int, 3>& at, double spacing_m) {
    Box box{Vec3(0.0), Vec3(0.0)};
    for (int axis = 0; axis < 3; ++axis) {
        const int first_node = at[static_cast<std::size_t>(axis)] * kTileCells;
        box.lo[axis] = (first_node - geometry::TileBlock::kReach) * spacing_m;
        box.hi[axis] = (first_node + kTileCells - 1 + geometry::TileBlock::kReach) * spacing_m;
    }
    return box;
}

// Tells whether a ball meets a closed box; `center` is relative to the lattice's origin.
bool ball_meets(const Box& box, const Vec3& center, double radius_m) {
    const Vec3 outside = glm::max(glm::max(box.lo - center, center - box.hi), Vec3(0.0));
    return glm::dot(outside, outside) <= radius_m * radius_m;
}

// Sets the block of tile places that may hold surface within the ball, at least one.
void choose_places(const Surface& surface, const Vec3& center, double radius_m, geometry::TileBlock& block) {
    const double spacing_m = surface.lattice().spacing_m, tile_m = spacing_m * kTileCells;
    const double before_m = (geometry::TileBlock::kReach - 1.0) * spacing_m,
                 beyond_m = geometry::TileBlock::kReach * spacing_m;
    std::size_t places = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const auto tile_at = [&](double along_m) {
            return static_cast<int>(std::clamp(std::floor(along_m / tile_m), 0.0, surface.grid().tiles[k] - 1.0));
        };
        block.first[k] = tile_at(center[axis] - radius_m - before_m);
        block.count[k] = tile_at(center[axis] + radius_m + beyond_m) - block.first[k] + 1;
        places *= static_cast<std::size_t>(block.count[k]);
    }
    block.cell_m = spacing_m;
    block.places.resize(places);
}

}  // namespace

void gather_local_surface(const Surface& surface, const Vec3& center_object, double radius_m,
                          geometry::LocalSurface& out) {
    out.origin_object = surface.lattice().origin_object;
    out.center_object = center_object;
    out.radius_m = radius_m;
    out.loose.reset();
    const Vec3 center = center_object - out.origin_object;
    geometry::TileBlock& block = out.tiles;
    choose_places(surface, center, radius_m, block);
    block.triangles = 0;
    auto place = block.places.begin();
    for (int z = block.first[2]; z < block.first[2] + block.count[2]; ++z)
        for (int y = block.first[1]; y < block.first[1] + block.count[1]; ++y)
            for (int x = block.first[0]; x < block.first[0] + block.count[0]; ++x, ++place) {
                const std::shared_ptr<const TileMesh>& tile = surface.shared_tile(surface.grid().index(x, y, z));
                const bool touched =
                    tile && ball_meets(reach_of_tile({x, y, z}, surface.lattice().spacing_m), center, radius_m);
                place->first_triangle = block.triangles;
                if (!touched) {
                    place->tile.reset();
                    continue;
                }
                // The draft often holds this reference already, from three publications before: then no reference count
                // changes.
                if (place->tile != tile) place->tile = tile;
                block.triangles += static_cast<std::uint32_t>(tile->triangles());
            }
}

}  // namespace burin::compute
