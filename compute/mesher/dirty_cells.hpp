// SPDX-License-Identifier: MIT
// Finds the cells, tile by tile, that the changes of one update can have altered.
//
// A changed ray affects the four columns of cells around it, over the depths that changed (cells_changed in
// shaders/shared/mesh_tile.h). A cell's vertices depend on nothing else: the signs of its corners and the crossings of
// its edges come from rays through its edges, and a crossing is searched for no farther than kNearEdge beyond its edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/mesher/tile_grid.hpp"
#include "compute/rays/ray_batch.hpp"

namespace burin::compute {

class DirtyCells {
public:
    explicit DirtyCells(const Lattice& lattice) : lattice_(lattice), grid_(lattice) {}

    // Sorts the changes by tile, on all threads when there are many; tiles() then lists the tiles they affect.
    void sort(const Changes& changes, WorkerPool& pool);
    [[nodiscard]] std::span<const std::uint32_t> tiles() const { return tiles_; }  // in increasing order
    // Returns the dirty cells of one of tiles(). Thread-safe.
    [[nodiscard]] CellMask mask(std::uint32_t tile) const;

private:
    static constexpr std::uint32_t kNone = 0xffffffff;
    // Dirty cells of one share of the changes; each share is marked by one thread.
    struct Share {
        std::vector<std::uint32_t> slot;  // index of each tile's mask in masks, or kNone
        std::vector<CellMask> masks;      // may be longer than tiles: masks are reused
        std::vector<std::uint32_t> tiles;

        [[nodiscard]] CellMask& mask_of(std::uint32_t tile);
    };
    void mark(std::span<const shared::ChangedRay> changes, Share& share) const;

    Lattice lattice_;
    TileGrid grid_;
    std::vector<Share> shares_;
    std::vector<std::uint32_t> tiles_;
};

}  // namespace burin::compute
