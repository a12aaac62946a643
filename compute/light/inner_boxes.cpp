// SPDX-License-Identifier: MIT
#include "compute/light/inner_boxes.hpp"

#include <algorithm>

namespace burin::compute {

bool InnerBoxes::full(const Occupancy& occupancy, const TileBox& box) const {
    for (std::size_t a = 0; a < 3; ++a) {
        if (box.lo[a] < 0 || box.hi[a] >= grid_.tiles[a]) return false;
    }
    for (int z = box.lo[2]; z <= box.hi[2]; ++z)
        for (int y = box.lo[1]; y <= box.hi[1]; ++y)
            for (int x = box.lo[0]; x <= box.hi[0]; ++x) {
                if (occupancy.state(grid_.index(x, y, z)) != Occupancy::Tile::full) return false;
            }
    return true;
}

void InnerBoxes::keep_true(const Occupancy& occupancy) {
    if (std::erase_if(tiles_, [&](const TileBox& box) { return !full(occupancy, box); }) > 0) state_boxes();
}

// Grows the box by one layer of full tiles at a time, on each side in turn.
InnerBoxes::TileBox InnerBoxes::grown(const Occupancy& occupancy, TileBox box) const {
    for (bool grew = true; grew;) {
        grew = false;
        for (std::size_t side = 0; side < 6; ++side) {
            const std::size_t axis = side / 2;
            TileBox layer = box;
            if (side % 2 == 0) {
                layer.lo[axis] = layer.hi[axis] = box.lo[axis] - 1;
            } else {
                layer.lo[axis] = layer.hi[axis] = box.hi[axis] + 1;
            }
            if (!full(occupancy, layer)) continue;
            (side % 2 == 0 ? box.lo : box.hi)[axis] = layer.lo[axis];
            grew = true;
        }
    }
    return box;
}

void InnerBoxes::find(const Occupancy& occupancy) {
    tiles_.clear();
    std::vector<std::uint8_t> taken(grid_.count(), 0);
    // For each tile, the side of the largest cube of full tiles not taken whose highest corner is that tile.
    std::vector<int> side(grid_.count());
    while (tiles_.size() < kMost) {
        std::uint32_t best = 0;
        std::ranges::fill(side, 0);
        for (int z = 0; z < grid_.tiles[2]; ++z)
            for (int y = 0; y < grid_.tiles[1]; ++y)
                for (int x = 0; x < grid_.tiles[0]; ++x) {
                    const std::uint32_t tile = grid_.index(x, y, z);
                    if (taken[tile] != 0 || occupancy.state(tile) != Occupancy::Tile::full) continue;
                    int least = x > 0 && y > 0 && z > 0 ? side[grid_.index(x - 1, y - 1, z - 1)] : 0;
                    for (int corner = 1; corner < 7 && least > 0; ++corner) {
                        const int cx = x - (corner & 1), cy = y - (corner >> 1 & 1), cz = z - (corner >> 2 & 1);
                        least = std::min(least, side[grid_.index(cx, cy, cz)]);
                    }
                    side[tile] = least + 1;
                    if (side[tile] > side[best]) best = tile;
                }
        if (side[best] == 0) break;
        TileBox cube{grid_.position(best), grid_.position(best)};
        for (int& lo : cube.lo) lo -= side[best] - 1;
        const TileBox box = grown(occupancy, cube);
        tiles_.push_back(box);
        for (int z = box.lo[2]; z <= box.hi[2]; ++z)
            for (int y = box.lo[1]; y <= box.hi[1]; ++y)
                for (int x = box.lo[0]; x <= box.hi[0]; ++x) taken[grid_.index(x, y, z)] = 1;
    }
    state_boxes();
}

Box InnerBoxes::object_box(const TileBox& box) const {
    Vec3 lo, hi;
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        lo[a] = box.lo[axis] * kTileCells + 1;
        hi[a] = box.hi[axis] * kTileCells + kTileCells - 2;
    }
    return {lattice_.origin_object + lo * lattice_.spacing_m, lattice_.origin_object + hi * lattice_.spacing_m};
}

void InnerBoxes::state_boxes() {
    boxes_object_.clear();
    for (const TileBox& box : tiles_) boxes_object_.push_back(object_box(box));
}

}  // namespace burin::compute
