// SPDX-License-Identifier: MIT
// The lattice cut into cubes of kTileCells cells a side, and the set of tiles whose mesh is out of date.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "compute/lattice.hpp"

namespace burin {

inline constexpr int kTileCells = 16;

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
};

// Marks may come from several threads at once; taking is for one thread, when no one marks.
class DirtyTiles {
public:
    explicit DirtyTiles(const Lattice& lattice) : grid_(lattice), marks_(grid_.count()) {}

    [[nodiscard]] const TileGrid& grid() const { return grid_; }

    void mark_all() {
        for (auto& mark : marks_) mark.store(1, std::memory_order_relaxed);
    }

    // The ray (u, v) of `axis` changed between the two depths (lattice units). A tile's mesh reads the rays up to two cells
    // beyond its own cells (one for the neighbouring cells it joins, one for ends that lie just outside an edge).
    void mark_ray(int axis, int u, int v, int depth_lo, int depth_hi) {
        constexpr int kReach = 2;
        const auto s = static_cast<std::size_t>(axis);
        std::array<int, 3> from{}, to{};
        const auto range = [&](std::size_t a, int lo_cell, int hi_cell) {
            from[a] = std::clamp((lo_cell - kReach) / kTileCells, 0, grid_.tiles[a] - 1);
            to[a] = std::clamp((hi_cell + kReach) / kTileCells, 0, grid_.tiles[a] - 1);
        };
        range(s, depth_lo / shared::kUnitsPerCell, depth_hi / shared::kUnitsPerCell);
        range((s + 1) % 3, u, u);
        range((s + 2) % 3, v, v);
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x) {
                    // relaxed: a mark carries no data with it; the worker pool's join publishes the solid.
                    marks_[grid_.index(x, y, z)].store(1, std::memory_order_relaxed);
                }
    }

    // The marked tiles in increasing order; afterwards none is marked.
    [[nodiscard]] std::vector<std::uint32_t> take() {
        std::vector<std::uint32_t> dirty;
        for (std::uint32_t i = 0; i < marks_.size(); ++i) {
            if (marks_[i].exchange(0, std::memory_order_relaxed) != 0) dirty.push_back(i);
        }
        return dirty;
    }

private:
    TileGrid grid_;
    std::vector<std::atomic<std::uint8_t>> marks_;
};

}  // namespace burin
