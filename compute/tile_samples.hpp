// SPDX-License-Identifier: MIT
// What the mesher knows of one tile: which nodes are inside, and the surface crossing on each crossed lattice edge that is
// asked for. Nodes are numbered from -1 to kTileCells around the tile's own 0 .. kTileCells - 1 ("local" coordinates).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compute/feature_point.hpp"
#include "compute/solid.hpp"
#include "compute/tile_grid.hpp"

namespace burin {

inline constexpr int kLocalNodes = kTileCells + 2;  // -1 .. kTileCells

// How far beyond an edge its crossing may lie, in lattice units (1/16 of a cell). Where the rays of a solid disagree about a
// node, they do so by the rounding of a depth, one unit; what lies farther off is another surface.
inline constexpr int kNearEdge = 256;

using Local = std::array<int, 3>;

// Where the surface crosses a lattice edge.
struct EdgeSample {
    Vec3f normal{0.0f};
    float along = 0.5f;  // 0 at the lower node, 1 at the upper
    std::uint8_t material = 0;
    bool disagrees = false;  // the edge's own rays do not have this crossing
};

class TileSamples {
public:
    // Reads the signs; false when no edge of the tile is crossed, and then the rest is undefined.
    [[nodiscard]] bool collect_signs(const Solid& solid, const std::array<int, 3>& first_node);
    // Reads the crossings of all edges of these cells; no others may be asked for.
    void collect_crossings(const Solid& solid, const std::array<int, 3>& first_node, const CellMask& cells);

    [[nodiscard]] bool inside(const Local& node) const { return (column(node[0], node[1]) >> (node[2] + 1) & 1u) != 0; }
    // Bit c of the result: corner c of the cell is inside.
    [[nodiscard]] unsigned cell_pattern(const Local& cell) const;
    // The edge from `node` one step along `axis` must be crossed.
    [[nodiscard]] const EdgeSample& sample(int axis, const Local& node) const {
        return sample_at(axis, node_index(node));
    }
    // By the node's number; the numbers of neighbours differ by node_offset of the way to them.
    [[nodiscard]] const EdgeSample& sample_at(int axis, std::size_t node) const {
        return samples_[sample_index_[static_cast<std::size_t>(axis)][node]];
    }
    [[nodiscard]] static constexpr std::size_t node_offset(const Local& way) {
        return static_cast<std::size_t>((way[2] * kLocalNodes + way[1]) * kLocalNodes + way[0]);
    }
    [[nodiscard]] static constexpr std::size_t node_index(const Local& n) {
        return node_offset({n[0] + 1, n[1] + 1, n[2] + 1});
    }
    // Bits z + 1 of the edges along `axis` from nodes (x, y, z) that are crossed.
    [[nodiscard]] std::uint32_t crossed(int axis, int x, int y) const;
    // The same of the tile's own edges.
    [[nodiscard]] std::uint32_t own_crossed(int axis, int x, int y) const {
        return crossed(axis, x, y) & (((1u << kTileCells) - 1u) << 1);
    }
    // The cells that the tile's own crossed edges touch.
    [[nodiscard]] CellMask cells_at_own_edges() const;

private:
    [[nodiscard]] std::uint32_t column(int x, int y) const {
        return columns_[static_cast<std::size_t>((y + 1) * kLocalNodes + x + 1)];
    }

    std::array<std::uint32_t, kLocalNodes * kLocalNodes> columns_{};  // bit z + 1: node z is inside
    std::array<std::array<std::uint16_t, kLocalNodes * kLocalNodes * kLocalNodes>, 3> sample_index_{};
    std::vector<EdgeSample> samples_;
};

}  // namespace burin
