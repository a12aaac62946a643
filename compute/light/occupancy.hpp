// SPDX-License-Identifier: MIT
// Which lattice nodes lie inside the solid: one bit per node, a tile of 16^3 nodes at a time; a tile that is wholly
// inside or wholly outside holds no bits. The signs are those of the mesher, so that light and mesh agree.
// Memory: 16 bytes a tile, and 512 more for a tile that the surface passes through.
// Threads: tiles may be read, and different tiles updated, from several threads at once.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "compute/mesher/tile_mesher.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

// A box of lattice nodes from lo to hi, both included.
struct NodeBox {
    std::array<int, 3> lo{}, hi{};

    [[nodiscard]] NodeBox grown(int nodes) const;
    void include(const NodeBox& other);
};

class Occupancy {
public:
    enum class Tile : std::uint8_t { empty, full, mixed };

    explicit Occupancy(const Lattice& lattice)
        : grid_(lattice), states_(grid_.count(), Tile::empty), columns_(grid_.count()) {}

    // Updates the signs of one tile from its mesh, or from the solid if it has none (null). Returns a box around the
    // nodes that changed.
    std::optional<NodeBox> update(std::uint32_t tile, const Solid& solid, const TileMesh* mesh);

    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    [[nodiscard]] Tile state(std::uint32_t tile) const { return states_[tile]; }
    // Bit z: the tile's own node (x, y, z) is inside.
    [[nodiscard]] std::uint32_t column(std::uint32_t tile, int x, int y) const {
        switch (states_[tile]) {
            case Tile::empty: return 0;
            case Tile::full: return kFullColumn;
            case Tile::mixed: break;
        }
        return (*columns_[tile])[static_cast<std::size_t>(y * kTileCells + x)];
    }
    // False outside the lattice.
    [[nodiscard]] bool inside(const std::array<int, 3>& node) const;
    [[nodiscard]] std::size_t bytes() const;

private:
    static constexpr std::uint32_t kFullColumn = (1u << kTileCells) - 1u;
    using Columns = std::array<std::uint16_t, kTileCells * kTileCells>;

    TileGrid grid_;
    std::vector<Tile> states_;
    std::vector<std::unique_ptr<Columns>> columns_;  // null for tiles that are not mixed
};

}  // namespace burin::compute
