// SPDX-License-Identifier: MIT
// What the mesher knows of one tile: which nodes are inside, and the surface crossing on each crossed lattice edge that is
// asked for. Nodes are numbered from -1 to kTileCells around the tile's own 0 .. kTileCells - 1 ("local" coordinates).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "compute/float4.hpp"
#include "compute/solid.hpp"
#include "compute/tile_grid.hpp"

namespace burin {

inline constexpr int kLocalNodes = kTileCells + 2;  // -1 .. kTileCells

// How far beyond an edge its crossing may lie, in lattice units (1/16 of a cell). Where the rays of a solid disagree about a
// node, they do so by the rounding of a depth, one unit; what lies farther off is another surface.
inline constexpr int kNearEdge = 256;

using Local = std::array<int, 3>;

// Where the surface crosses a lattice edge.
struct alignas(16) EdgeSample {
    Vec3f normal;
    float along;             // 0 at the lower node, 1 at the upper
    std::uint16_t own_edge;  // as in SurfaceTile::quads
    std::uint8_t material;
    bool disagrees;     // the edge's own rays do not have this crossing
    bool lower_inside;  // the lower node is
    std::uint8_t axis;
    std::array<std::int8_t, 3> node;  // the lower one

    static constexpr std::uint16_t kNotOwn = 0xffff;
    [[nodiscard]] Float4 normal_and_along() const {
        Float4 v;
        __builtin_memcpy(&v, this, sizeof v);
        return v;
    }
};

// A word for each column of nodes; bit z + 1 stands for what is at height z.
using NodeColumns = std::array<std::uint32_t, kLocalNodes * kLocalNodes>;
// Lattice edges, axis by axis, by their lower nodes.
using EdgeMask = std::array<NodeColumns, 3>;

// All edges of these cells, crossed or not, own or not.
[[nodiscard]] EdgeMask edges_of(const CellMask& cells);

class TileSamples {
public:
    // Reads the signs; false when no edge of the tile is crossed, and then the rest is undefined. With the signs as they were
    // before, only those columns are read anew that touch a dirty cell.
    [[nodiscard]] bool collect_signs(const Solid& solid, const std::array<int, 3>& first_node,
                                     const NodeColumns* before, const CellMask& dirty);
    [[nodiscard]] const NodeColumns& signs() const { return columns_; }
    // The cells that the tile's own crossed edges touch.
    [[nodiscard]] CellMask cells_at_own_edges() const;
    // Reads the crossings of all edges of these cells; no others may be asked for.
    void collect_crossings(const Solid& solid, const std::array<int, 3>& first_node, const CellMask& cells);
    // By axis, then in the order y, x, z of their lower nodes.
    [[nodiscard]] std::span<const EdgeSample> samples() const { return {samples_.get(), count_}; }

    // The signs along the four edges of a column of cells that go upwards: at (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1).
    [[nodiscard]] std::array<std::uint32_t, 4> corner_signs(int x, int y) const {
        const std::uint32_t* const corner = &columns_[column(x, y)];
        return {corner[0], corner[1], corner[kLocalNodes], corner[kLocalNodes + 1]};
    }
    // Bit c of the result: corner c of the cell is inside.
    [[nodiscard]] static unsigned cell_pattern(const std::array<std::uint32_t, 4>& corners, int z) {
        unsigned pattern = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const unsigned both = corners[c] >> (z + 1);  // the lower and the upper node
            pattern |= (both & 1u) << c | (both & 2u) << (c + 3);
        }
        return pattern;
    }
    [[nodiscard]] unsigned cell_pattern(const Local& cell) const {
        return cell_pattern(corner_signs(cell[0], cell[1]), cell[2]);
    }
    [[nodiscard]] bool inside(const Local& node) const {
        return (columns_[column(node[0], node[1])] >> (node[2] + 1) & 1u) != 0;
    }
    // The crossed edge from `node` one step along `axis`. By its number: those of other edges differ by edge_offset.
    [[nodiscard]] const EdgeSample& sample(int axis, const Local& node) const {
        return sample_at(edge_offset(axis, {node[0] + 1, node[1] + 1, node[2] + 1}));
    }
    [[nodiscard]] const EdgeSample& sample_at(std::size_t edge) const { return samples_[sample_index_[edge]]; }
    // Which of samples() belongs to an edge, by its number.
    [[nodiscard]] const std::uint16_t* sample_indices() const { return sample_index_.data(); }
    [[nodiscard]] static constexpr std::size_t edge_offset(int axis, const Local& way) {
        return static_cast<std::size_t>(((axis * kLocalNodes + way[2]) * kLocalNodes + way[1]) * kLocalNodes + way[0]);
    }
    [[nodiscard]] static constexpr std::size_t column(int x, int y) {
        return static_cast<std::size_t>((y + 1) * kLocalNodes + x + 1);
    }

private:
    void find_crossed();
    template <int axis>
    void collect_along(const Solid& solid, const std::array<int, 3>& first_node, const NodeColumns& edges);
    template <int axis>
    void collect_column(const Solid& solid, const std::array<int, 3>& first_node, int x, int y, std::uint32_t edges);

    NodeColumns columns_{};  // the inside nodes
    EdgeMask crossed_{};
    std::array<std::uint16_t, 3 * kLocalNodes * kLocalNodes * kLocalNodes> sample_index_{};
    // As many as there can be; memory that is never written is never there.
    static constexpr std::size_t kMostEdges = 3 * kLocalNodes * kLocalNodes * kLocalNodes;
    std::unique_ptr<EdgeSample[]> samples_ = std::make_unique_for_overwrite<EdgeSample[]>(kMostEdges);
    std::size_t count_ = 0;
};

}  // namespace burin
