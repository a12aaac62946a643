// SPDX-License-Identifier: MIT
// The lattice cut into cubes of kTileCells cells a side.
//
// A tile owns the nodes with local coordinates 0 .. kTileCells - 1 and the lattice edges that start at them. It also knows
// the cells one below its own, -1, since its edges touch them: it "sees" the cells -1 .. kTileCells - 1.
#pragma once

#include <array>
#include <cstdint>

#include "compute/lattice.hpp"
#include "geometry/surface_tile.hpp"

namespace burin {

inline constexpr int kTileCells = SurfaceTile::kCells;
inline constexpr int kSeenCells = kTileCells + 1;  // -1 .. kTileCells - 1

struct TileGrid {
    std::array<int, 3> tiles{0, 0, 0};

    explicit TileGrid(const Lattice& lattice) {
        // One more than the cells: the tile owns nodes, and there is one more node than cells.
        for (std::size_t a = 0; a < 3; ++a) tiles[a] = lattice.cells[a] / kTileCells + 1;
    }
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(tiles[0]) * static_cast<std::size_t>(tiles[1]) *
               static_cast<std::size_t>(tiles[2]);
    }
    [[nodiscard]] std::uint32_t index(int x, int y, int z) const {
        return static_cast<std::uint32_t>((z * tiles[1] + y) * tiles[0] + x);
    }
    [[nodiscard]] std::array<int, 3> position(std::uint32_t index) const {
        const int i = static_cast<int>(index);
        return {i % tiles[0], i / tiles[0] % tiles[1], i / (tiles[0] * tiles[1])};
    }
    // The tile's node with local coordinates 0, 0, 0.
    [[nodiscard]] std::array<int, 3> first_node(std::uint32_t index) const {
        std::array<int, 3> node = position(index);
        for (int& n : node) n *= kTileCells;
        return node;
    }
};

// A bit for each cell that a tile sees: bit z + 1 of column (x, y).
struct CellMask {
    std::array<std::uint32_t, kSeenCells * kSeenCells> columns{};
    static constexpr std::uint32_t kAll = (1u << kSeenCells) - 1u;

    [[nodiscard]] static std::size_t column(int x, int y) {
        return static_cast<std::size_t>((y + 1) * kSeenCells + x + 1);
    }
    [[nodiscard]] std::uint32_t at(int x, int y) const { return columns[column(x, y)]; }
    void add(int x, int y, std::uint32_t bits) { columns[column(x, y)] |= bits; }
    void set_all() { columns.fill(kAll); }
};

}  // namespace burin
