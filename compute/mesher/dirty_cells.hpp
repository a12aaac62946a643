// SPDX-License-Identifier: MIT
// Which cells of which tiles an update's changes can have altered.
//
// A changed ray touches the four columns of cells around it, over the depths that changed. A cell's vertex depends on nothing
// else: signs of its corners and crossings of its edges come from rays through its edges, and a crossing is looked for no
// farther than kNearEdge beyond its edge (tile_samples.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/ray_batch.hpp"
#include "compute/tile_grid.hpp"

namespace burin {

class DirtyCells {
public:
    explicit DirtyCells(const Lattice& lattice) : lattice_(lattice), grid_(lattice) {}

    // Sorts the changes by tile, on all threads when there are many; the tiles they touch are then tiles().
    void sort(const Changes& changes, WorkerPool& pool);
    [[nodiscard]] std::span<const std::uint32_t> tiles() const { return tiles_; }  // in increasing order
    // The cells of one of these tiles. Thread-safe.
    [[nodiscard]] CellMask mask(std::uint32_t tile) const;

private:
    static constexpr std::uint32_t kNone = 0xffffffff;
    // Cells of the lattice, -1 being the empty layer below the first.
    struct CellRange {
        std::array<int, 3> lo, hi;
    };
    // What some of the changes touch: each share is marked by one thread.
    struct Share {
        std::vector<std::uint32_t> slot;  // of each tile: its place in masks, or none
        std::vector<CellMask> masks;      // more than there are tiles now
        std::vector<std::uint32_t> tiles;

        [[nodiscard]] CellMask& mask_of(std::uint32_t tile);
    };
    [[nodiscard]] static CellRange range_of(const shared::ChangedRay& change);
    void mark(std::span<const shared::ChangedRay> changes, Share& share) const;

    Lattice lattice_;
    TileGrid grid_;
    std::vector<Share> shares_;
    std::vector<std::uint32_t> tiles_;
};

}  // namespace burin
