// SPDX-License-Identifier: MIT
// Dual contouring of one tile: from the rays that pass through it to the triangles of the lattice edges it owns.
//
// Data flow: z rays -> inside/outside bits of the tile's nodes; all three sets -> where the surface crosses each lattice
// edge (position, normal, material); cells -> vertices; crossed edges -> quads -> triangles. A tile owns the lattice edges
// that start at its own nodes; it computes the vertices of the neighbouring cells that those quads touch itself, from the
// same rays with the same arithmetic, so tiles meet without cracks and can be meshed alone, in any order, on any thread.
// After a change only the vertices of the cells that may differ are computed; the others are copied, in the one order that
// every mesh of the tile has, so that the result is bit for bit that of meshing the whole tile anew.
//
// Hardest case: rays of different directions disagree about a node (each was cut at its own rounded depth), or a sliver
// thinner than a cell passes between nodes. The rule: the z rays decide every sign. An edge along x or y then takes the
// nearest end of the right kind within kNearEdge of it, clamped to the edge, or else its middle and the edge's own direction
// as the normal; such edges are counted. The mesh is closed whatever the rays say.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compute/solid.hpp"
#include "compute/tile_grid.hpp"
#include "compute/tile_samples.hpp"
#include "geometry/surface_tile.hpp"

namespace burin {

struct TileMesh : SurfaceTile {
    std::uint32_t disagreeing_edges = 0;  // of this tile's own edges

    // How the vertices are made up, in increasing order of cells; for meshing a part anew and for naming vertices. First come
    // those of the cells, then the extra vertices on faces (cell_table.hpp).
    struct Cell {
        std::uint16_t cell = 0;          // ((y + 1) * kSeenCells + x + 1) * kSeenCells + z + 1
        std::uint16_t first_vertex = 0;  // its vertices end where the next cell's begin
    };
    static constexpr std::uint64_t kNoVertex = 0xf;
    std::vector<Cell> cells;
    // For each cell: bits 4e .. 4e + 3: which of the cell's vertices edge e uses, or kNoVertex; bits 48 + 4l ..: the first
    // vertex of loop l = 1, 2, 3, or kNoVertex; and kPassedTwice.
    std::vector<std::uint64_t> vertex_of_edge;
    static constexpr std::uint64_t kPassedTwice = std::uint64_t{1}
                                                  << 48;  // a loop passes a face twice (cell_table.hpp)
    std::vector<std::uint64_t> face_keys;                 // of the extra vertices
    bool has_twice_passed_faces = false;                  // in any cell
    NodeColumns signs{};                                  // of the nodes that it sees

    [[nodiscard]] std::size_t cell_vertices() const { return vertices.size() - face_keys.size(); }
};

struct TileWork {
    std::uint32_t cells = 0;      // whose vertices were computed
    std::uint32_t triangles = 0;  // that were made anew, because a cell at one of their corners was
};

// The tile's mesh, `old` being the one before: the cells of the mask anew, the others copied; those must be as they were when
// `old` was made. Thread-safe as long as the solid does not change. `fresh` is not `old`.
TileWork mesh_tile(const Solid& solid, const TileGrid& grid, std::uint32_t tile, const CellMask& dirty,
                   const TileMesh& old, TileMesh& fresh);

// The name of each vertex: the same for one point of the surface in all tiles, (cell index in the lattice) * 16 + slot. Slots
// 0 to 3 are the cell's loops; slot 4 + 2 * axis + pair is the extra vertex on the cell's lower face of that axis.
[[nodiscard]] std::vector<std::uint64_t> vertex_keys(const Lattice& lattice, const std::array<int, 3>& first_node,
                                                     const TileMesh& mesh);

}  // namespace burin
