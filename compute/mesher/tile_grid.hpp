// SPDX-License-Identifier: MIT
// The division of the lattice into tiles: cubes of kTileCells cells a side.
//
// A tile owns the nodes with local coordinates 0 .. kTileCells - 1 and the lattice edges that start at them. It also
// knows the layer of cells below its own, -1, since its edges touch them: it "sees" the cells -1 .. kTileCells - 1.
#pragma once

#include <array>
#include <cstdint>

#include "compute/rays/lattice.hpp"
#include "geometry/contact/surface_tile.hpp"
#include "shaders/shared/mesh_tile.h"

namespace burin::compute {

inline constexpr int kTileCells = geometry::SurfaceTile::kCells;
inline constexpr int kSeenCells = shared::kMeshCells;  // -1 .. kTileCells - 1
static_assert(kTileCells == shared::kMeshTile);

struct TileGrid {
    std::array<int, 3> tiles{0, 0, 0};

    explicit TileGrid(const Lattice& lattice) {
        // A tile owns nodes, and there is one more node than cells along each axis.
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
    // Returns the tile's node with local coordinates 0, 0, 0, in lattice coordinates.
    [[nodiscard]] std::array<int, 3> first_node(std::uint32_t index) const {
        std::array<int, 3> node = position(index);
        for (int& n : node) n *= kTileCells;
        return node;
    }
};

// Returns the number of bits of up to 31 words, word(0) and so on. Counts within bytes, so that the compiler counts
// several words at once.
template <typename Word>
[[nodiscard]] constexpr std::uint32_t bits_of_row(std::size_t words, Word&& word) {
    std::uint32_t bytes = 0;
    for (std::size_t i = 0; i < words; ++i) {
        std::uint32_t bits = word(i);
        bits -= bits >> 1 & 0x55555555u;
        bits = (bits & 0x33333333u) + (bits >> 2 & 0x33333333u);
        bytes += (bits + (bits >> 4)) & 0x0f0f0f0fu;
    }
    const std::uint32_t pairs = (bytes & 0x00ff00ffu) + (bytes >> 8 & 0x00ff00ffu);
    return (pairs & 0xffffu) + (pairs >> 16);
}

// One bit for each cell that a tile sees: bit z + 1 of column (x, y).
struct CellMask {
    std::array<std::uint32_t, kSeenCells * kSeenCells> columns{};
    static constexpr std::uint32_t kAll = (1u << kSeenCells) - 1u;

    [[nodiscard]] static std::size_t column(int x, int y) {
        return static_cast<std::size_t>((y + 1) * kSeenCells + x + 1);
    }
    [[nodiscard]] std::uint32_t at(int x, int y) const { return columns[column(x, y)]; }
    void add(int x, int y, std::uint32_t bits) { columns[column(x, y)] |= bits; }
    void set_all() { columns.fill(kAll); }
    [[nodiscard]] std::size_t count() const {
        std::size_t cells = 0;
        for (std::size_t row = 0; row < columns.size(); row += kSeenCells)
            cells += bits_of_row(kSeenCells, [&](std::size_t i) { return columns[row + i]; });
        return cells;
    }
};

}  // namespace burin::compute
