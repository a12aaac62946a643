// SPDX-License-Identifier: MIT
// Dual contouring of one tile: turns the rays that pass through it into the triangles of the lattice edges it owns.
//
// Data flow: z rays -> inside/outside bits of the tile's nodes; all three sets -> where the surface crosses each
// lattice edge (position, normal, material); cells -> vertices; crossed edges -> quads -> triangles. A tile owns the
// lattice edges that start at its own nodes. It computes the vertices of the neighbouring cells that their quads use
// itself, from the same rays with the same arithmetic, so tiles meet without cracks and can be meshed alone, in any
// order, on any thread. After a change only the vertices of the cells that may differ are computed; the others are
// copied, in the one order that every mesh of the tile has, so that the result equals meshing the whole tile from
// scratch bit for bit.
//
// Hardest case: rays of different directions disagree about a node (each was cut at its own rounded depth), or a sliver
// thinner than a cell passes between nodes. The rule: the z rays decide every sign. An edge along x or y then takes the
// nearest end of the right kind within kNearEdge of it, clamped to the edge, or else its midpoint with the edge's own
// direction as the normal; such edges are counted. The mesh is closed whatever the rays hold.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "compute/mesher/made_cells.hpp"
#include "compute/mesher/tile_grid.hpp"
#include "compute/mesher/tile_samples.hpp"
#include "compute/rays/solid.hpp"
#include "geometry/contact/surface_tile.hpp"

namespace burin::compute {

struct TileMesh : geometry::SurfaceTile {
    std::uint32_t disagreeing_edges = 0;  // among this tile's own edges

    // Origin of the vertices, by cell id in increasing order; needed to re-mesh a part and to key the vertices. The
    // vertices of the cells come first, then the extra vertices on faces (cell_table.hpp).
    struct Cell {
        std::uint16_t cell = 0;          // ((y + 1) * kSeenCells + x + 1) * kSeenCells + z + 1
        std::uint16_t first_vertex = 0;  // its vertices end where the next cell's begin
    };
    static constexpr std::uint64_t kNoVertex = 0xf;
    std::vector<Cell> cells;
    // One word for each cell. Bits 4e .. 4e + 3: which of the cell's vertices edge e uses, or kNoVertex. Bits 48 + 4l
    // to 51 + 4l: the first vertex of loop l = 1, 2, 3, or kNoVertex. Bit 48: kPassedTwice.
    std::vector<std::uint64_t> vertex_of_edge;
    // Flag: a loop passes a face of the cell twice (cell_table.hpp).
    static constexpr std::uint64_t kPassedTwice = std::uint64_t{1} << 48;
    std::vector<std::uint64_t> face_keys;  // keys of the extra vertices
    bool has_twice_passed_faces = false;   // true if any cell has kPassedTwice
    NodeColumns signs{};                   // inside/outside bits of the nodes that it sees

    [[nodiscard]] std::size_t cell_vertices() const { return vertices.size() - face_keys.size(); }
};

struct TileWork {
    std::uint32_t cells = 0;      // cells whose vertices were computed
    std::uint32_t triangles = 0;  // triangles rebuilt because a cell at one of their corners was
};

// Makes the tile's mesh `fresh` from the previous one, `old`: recomputes the cells of the mask and copies the others,
// whose data must not have changed since `old` was made. Thread-safe as long as the solid does not change. `fresh` and
// `old` must be different objects.
TileWork mesh_tile(const Solid& solid, const TileGrid& grid, std::uint32_t tile, const CellMask& dirty,
                   const TileMesh& old, TileMesh& fresh);

// Makes the same mesh from the previous one and the cells that a device has made, without reading a ray. Returns
// nothing, and leaves `fresh` undefined, where the tile is to be meshed as above: the device has left it to the host,
// or there are twice passed faces before or after. So it does where the numbers of a faulty device lie beyond their
// lists or the tile, are out of order, or do not make whole quads; wrong places and normals it cannot tell.
// Thread-safe. `fresh` and `old` must be different objects.
[[nodiscard]] std::optional<TileWork> compose_tile(const Solid& solid, const TileGrid& grid, const MadeCells& made,
                                                   const shared::MadeTile& tile, const TileMesh& old, TileMesh& fresh);

// Returns the key of each vertex, which is the same in all tiles for one point of the surface: (cell index in the
// lattice) * 16 + slot. Slots 0 to 3 are the cell's loops; slot 4 + 2 * axis + pair is the extra vertex on the cell's
// lower face of that axis.
[[nodiscard]] std::vector<std::uint64_t> vertex_keys(const Lattice& lattice, const std::array<int, 3>& first_node,
                                                     const TileMesh& mesh);

}  // namespace burin::compute
