// SPDX-License-Identifier: MIT
// One tile's part of the cells that a device has made (made_cells.hpp), with its numbers checked. A device that works
// gives no wrong number; one that does not must not make the host read or write beyond a list.
#pragma once

#include <optional>
#include <span>

#include "compute/mesher/made_cells.hpp"
#include "compute/mesher/tile_grid.hpp"

namespace burin::compute {

// Refers to the MadeCells that it is a part of.
struct MadePart {
    std::span<const shared::MadeCell> cells;  // in increasing order; each has vertices, and all of them are in the list
    std::span<const shared::MadeEdge> edges;  // TileSamples::take_crossings checks their numbers
    std::span<const std::uint32_t> signs;     // of nodes that a tile sees
    const shared::SurfaceVertex* vertices = nullptr;  // of all tiles
    CellMask mask;                                    // the made cells
};

// Returns nothing where a number is out of its range or order, or a loop passes a face of a made cell twice.
[[nodiscard]] std::optional<MadePart> part_of(const MadeCells& made, const shared::MadeTile& tile);

[[nodiscard]] inline std::size_t number_of(const shared::MadeCell& cell) { return cell.what & 0xffffu; }
[[nodiscard]] inline std::size_t vertices_of(const shared::MadeCell& cell) { return cell.what >> 16; }
[[nodiscard]] inline std::uint64_t of_edge(const shared::MadeCell& cell) {
    return std::uint64_t{cell.of_edge_high} << 32 | cell.of_edge_low;
}

}  // namespace burin::compute
