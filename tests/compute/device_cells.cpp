// SPDX-License-Identifier: MIT
#include "tests/compute/device_cells.hpp"

#include "compute/mesher/dirty_cells.hpp"
#include "compute/mesher/tile_mesher.hpp"
#include "compute/mesher/tile_samples.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::shared {
namespace {

// Adapts a ray in host memory to shaders/shared/ray_crossing.h.
struct RayOfStandIn {
    const DexelEnd* ends;
    [[nodiscard]] DexelEnd load_end(uint i) const { return ends[i]; }
#include "shaders/shared/ray_crossing.h"
};

}  // namespace
}  // namespace burin::shared

namespace burin::compute::test {
namespace {

class StandIn {
public:
    StandIn(const Solid& solid, const TileGrid& grid) : solid_(solid), grid_(grid) {}

    void add(std::uint32_t tile, const CellMask& dirty) {
        first_node_ = grid_.first_node(tile);
        CellMask all;
        all.set_all();
        mesh_tile(solid_, grid_, tile, all, TileMesh(), whole_);
        static_cast<void>(samples_.collect_signs(solid_, first_node_, nullptr, all));
        shared::MadeTile made{};
        made.tile = tile;
        std::ranges::copy(samples_.signs(), made.signs);
        made.first_cell = static_cast<std::uint32_t>(made_.cells.size());
        made.first_edge = static_cast<std::uint32_t>(made_.edges.size());
        const CellMask reached = add_cells(dirty);
        add_edges(reached);
        for (std::size_t i = made.first_cell; i < made_.cells.size(); ++i)
            made.left |= made_.cells[i].of_edge_high >> 16 & 1u;  // TileMesh::kPassedTwice
        if (made.left != 0) {
            made_.cells.resize(made.first_cell);
            made_.edges.resize(made.first_edge);
        }
        made.cells = static_cast<std::uint32_t>(made_.cells.size()) - made.first_cell;
        made.edges = static_cast<std::uint32_t>(made_.edges.size()) - made.first_edge;
        made_.tiles.push_back(made);
    }

    [[nodiscard]] MadeCells take() { return std::move(made_); }

private:
    // Returns the cells that were added.
    CellMask add_cells(const CellMask& dirty) {
        CellMask added;
        for (std::size_t i = 0; i < whole_.cells.size(); ++i) {
            const TileMesh::Cell& cell = whole_.cells[i];
            const std::uint32_t bit = 1u << (cell.cell % kSeenCells);
            if ((dirty.columns[cell.cell / kSeenCells] & bit) == 0) continue;
            added.columns[cell.cell / kSeenCells] |= bit;
            const std::size_t end =
                i + 1 < whole_.cells.size() ? whole_.cells[i + 1].first_vertex : whole_.cell_vertices();
            made_.cells.push_back({static_cast<std::uint32_t>(cell.cell | (end - cell.first_vertex) << 16),
                                   static_cast<std::uint32_t>(made_.vertices.size()),
                                   static_cast<std::uint32_t>(whole_.vertex_of_edge[i]),
                                   static_cast<std::uint32_t>(whole_.vertex_of_edge[i] >> 32)});
            for (std::size_t v = cell.first_vertex; v < end; ++v) made_.vertices.push_back(whole_.vertices[v]);
        }
        return added;
    }

    void add_edges(const CellMask& cells) {
        for (const std::uint16_t quad : whole_.quads) {
            const int edge = quad & TileMesh::kQuadEdge;
            const std::size_t axis = static_cast<std::size_t>(edge / 4096), u = (axis + 1) % 3, v = (axis + 2) % 3;
            const Local node{edge / 16 % 16, edge / 256 % 16, edge % 16};
            bool beside = false;
            for (int i = 0; i < 4; ++i) {
                Local cell = node;
                cell[u] -= i % 2;
                cell[v] -= i / 2;
                beside |= (cells.at(cell[0], cell[1]) >> (cell[2] + 1) & 1u) != 0;
            }
            if (!beside) continue;
            const bool inside = samples_.inside(node);
            const auto ends = solid_.sets[axis].ends(first_node_[u] + node[u], first_node_[v] + node[v]);
            const auto crossing = shared::RayOfStandIn{ends.data()}.edge_crossing(
                static_cast<std::uint32_t>(ends.size()), static_cast<int>(axis), first_node_[axis] + node[axis],
                inside);
            made_.edges.push_back({static_cast<std::uint32_t>(edge) | (crossing.disagrees ? TileMesh::kDisagrees : 0u) |
                                       (inside ? 1u << 16 : 0u),
                                   crossing.normal});
        }
    }

    const Solid& solid_;
    const TileGrid& grid_;
    std::array<int, 3> first_node_{};
    TileMesh whole_;
    TileSamples samples_;
    MadeCells made_;
};

}  // namespace

MadeCells device_cells(const Solid& solid, const Changes& changes, WorkerPool& pool) {
    DirtyCells dirty(solid.lattice);
    dirty.sort(changes, pool);
    const TileGrid grid(solid.lattice);
    StandIn device(solid, grid);
    for (const std::uint32_t tile : dirty.tiles()) device.add(tile, dirty.mask(tile));
    return device.take();
}

}  // namespace burin::compute::test
