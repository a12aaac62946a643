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

#include "compute/ray_batch.hpp"
#include "compute/tile_grid.hpp"

namespace burin {

class DirtyCells {
public:
    explicit DirtyCells(const Lattice& lattice) : lattice_(lattice), grid_(lattice), newest_(grid_.count(), kNone) {}

    // Sorts the changes by tile; the tiles they touch are then tiles().
    void sort(const Changes& changes);
    [[nodiscard]] std::span<const std::uint32_t> tiles() const { return tiles_; }  // in increasing order
    // The cells of one of these tiles. Thread-safe.
    [[nodiscard]] CellMask mask(std::uint32_t tile) const;

private:
    static constexpr std::uint32_t kNone = 0xffffffff;
    // Cells of the lattice, -1 being the empty layer below the first.
    struct CellRange {
        std::array<std::int16_t, 3> lo, hi;
    };
    // A change in the list of a tile, and the entry before it.
    struct Entry {
        CellRange range;
        std::uint32_t before;
    };
    [[nodiscard]] static CellRange range_of(const shared::ChangedRay& change);

    Lattice lattice_;
    TileGrid grid_;
    std::vector<std::uint32_t> newest_;  // of each tile: its last entry
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> tiles_;
};

}  // namespace burin
