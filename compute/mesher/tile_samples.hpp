// SPDX-License-Identifier: MIT
// The mesher's input for one tile: which nodes are inside, and the surface crossing on each crossed lattice edge that
// was requested. Nodes are numbered from -1 to kTileCells around the tile's own 0 .. kTileCells - 1 ("local"
// coordinates).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "base/space.hpp"
#include "compute/mesher/tile_grid.hpp"
#include "compute/rays/solid.hpp"
#include "shaders/shared/made_cells.h"
#include "shaders/shared/mesh_tile.h"
#include "shaders/shared/vectors.h"

namespace burin::compute {

inline constexpr int kLocalNodes = shared::kMeshNodes;  // -1 .. kTileCells

using Local = std::array<int, 3>;

// The point where the surface crosses a lattice edge.
struct alignas(16) EdgeSample {
    Vec3f normal;
    float along;             // 0 at the lower node, 1 at the upper
    std::uint16_t own_edge;  // numbered as in SurfaceTile::quads, or kNotOwn
    std::uint8_t material;
    bool disagrees;     // the edge's own rays do not hold this crossing
    bool lower_inside;  // the edge's lower node is inside
    std::uint8_t axis;
    std::array<std::int8_t, 3> node;  // the edge's lower node

    static constexpr std::uint16_t kNotOwn = 0xffff;
    [[nodiscard]] shared::Float3 unit_normal() const {  // `along` is in the fourth lane, which is never read
        shared::Float3 v;
        __builtin_memcpy(&v, this, sizeof v);
        return v;
    }
};

// One word for each column of nodes; bit z + 1 belongs to height z.
using NodeColumns = std::array<std::uint32_t, kLocalNodes * kLocalNodes>;
// A bit for each lattice edge, axis by axis, at the edge's lower node.
using EdgeMask = std::array<NodeColumns, 3>;

// Returns all edges of these cells, whether crossed or not and whether the tile owns them or not.
[[nodiscard]] EdgeMask edges_of(const CellMask& cells);

class TileSamples {
public:
    // Reads the signs. Returns false when no edge of the tile is crossed; the other members are then undefined. If the
    // earlier signs are given, only the columns that touch a dirty cell are read.
    [[nodiscard]] bool collect_signs(const Solid& solid, const std::array<int, 3>& first_node,
                                     const NodeColumns* before, const CellMask& dirty);
    // Takes the signs that a device has read, in place of reading them.
    [[nodiscard]] bool take_signs(std::span<const std::uint32_t> signs);
    [[nodiscard]] const NodeColumns& signs() const { return columns_; }
    // Tells whether the corners of these cells have the signs that they had before.
    [[nodiscard]] bool same_signs(const NodeColumns& before, const CellMask& cells) const;
    // Returns the cells that touch one of the tile's own crossed edges.
    [[nodiscard]] CellMask cells_at_own_edges() const;
    // Reads the crossings of all edges of these cells; no other edge may be passed to sample().
    void collect_crossings(const Solid& solid, const std::array<int, 3>& first_node, const CellMask& cells);
    // Takes the crossings of the tile's own edges among these from a device, in place of reading them. They have no
    // place on their edge and no material, and cannot be passed to sample(). Returns false, and leaves the crossings
    // undefined, unless each of the tile's own crossed edges among these is there once, in order, with its sign.
    [[nodiscard]] bool take_crossings(std::span<const shared::MadeEdge> crossings, const EdgeMask& edges);
    // Returns the crossings ordered by axis, then by y, x, z of their lower nodes.
    [[nodiscard]] std::span<const EdgeSample> samples() const { return {samples_.get(), count_}; }

    // Returns the signs along the four vertical edges of a column of cells, at (x, y), (x + 1, y), (x, y + 1) and
    // (x + 1, y + 1).
    [[nodiscard]] std::array<std::uint32_t, 4> corner_signs(int x, int y) const {
        const std::uint32_t* const corner = &columns_[column(x, y)];
        return {corner[0], corner[1], corner[kLocalNodes], corner[kLocalNodes + 1]};
    }
    // Returns a pattern whose bit c is set when corner c of the cell is inside.
    [[nodiscard]] static unsigned cell_pattern(const std::array<std::uint32_t, 4>& corners, int z) {
        return shared::corner_pattern(corners[0], corners[1], corners[2], corners[3], static_cast<unsigned>(z + 1));
    }
    [[nodiscard]] unsigned cell_pattern(const Local& cell) const {
        return cell_pattern(corner_signs(cell[0], cell[1]), cell[2]);
    }
    [[nodiscard]] bool inside(const Local& node) const {
        return (columns_[column(node[0], node[1])] >> (node[2] + 1) & 1u) != 0;
    }
    // Returns the sample of the crossed edge from `node` one step along `axis`.
    [[nodiscard]] const EdgeSample& sample(int axis, const Local& node) const {
        return sample_at(edge_offset(axis, {node[0] + 1, node[1] + 1, node[2] + 1}));
    }
    [[nodiscard]] const EdgeSample& sample_at(std::size_t edge) const { return samples_[sample_index_[edge]]; }
    // Returns the table that maps an edge's number to its index in samples(). Numbers of edges differ by edge_offset.
    [[nodiscard]] const std::uint16_t* sample_indices() const { return sample_index_.data(); }
    [[nodiscard]] static constexpr std::size_t edge_offset(int axis, const Local& way) {
        return static_cast<std::size_t>(((axis * kLocalNodes + way[2]) * kLocalNodes + way[1]) * kLocalNodes + way[0]);
    }
    [[nodiscard]] static constexpr std::size_t column(int x, int y) {
        return static_cast<std::size_t>((y + 1) * kLocalNodes + x + 1);
    }

private:
    // Returns false when no edge is crossed.
    bool find_crossed();
    // Returns the number of the tile's own crossed edges among these.
    [[nodiscard]] std::size_t own_crossed(const EdgeMask& edges) const;
    template <int axis>
    void collect_along(const Solid& solid, const std::array<int, 3>& first_node, const NodeColumns& edges);
    template <int axis>
    void collect_column(const Solid& solid, const std::array<int, 3>& first_node, int x, int y, std::uint32_t edges);

    NodeColumns columns_{};  // bits of the inside nodes
    EdgeMask crossed_{};
    std::array<std::uint16_t, 3 * kLocalNodes * kLocalNodes * kLocalNodes> sample_index_{};
    // Room for the largest possible number; pages that are never written take no physical memory.
    static constexpr std::size_t kMostEdges = 3 * kLocalNodes * kLocalNodes * kLocalNodes;
    std::unique_ptr<EdgeSample[]> samples_ = std::make_unique_for_overwrite<EdgeSample[]>(kMostEdges);
    std::size_t count_ = 0;
};

}  // namespace burin::compute
