// SPDX-License-Identifier: MIT
// Dual contouring of one tile: from the rays that pass through it to the triangles of the lattice edges it owns.
//
// Data flow: z rays -> inside/outside bits of the tile's nodes; all three sets -> where the surface crosses each lattice
// edge (position, normal, material); cells -> vertices; crossed edges -> quads -> triangles. A tile owns the lattice edges
// that start at its own nodes; it computes the vertices of the neighbouring cells that those quads touch itself, from the
// same rays with the same arithmetic, so tiles meet without cracks and can be meshed alone, in any order, on any thread.
//
// Hardest case: rays of different directions disagree about a node (each was cut at its own rounded depth), or a sliver
// thinner than a cell passes between nodes. The rule: the z rays decide every sign. An edge along x or y then takes the
// nearest end of the right kind within one cell of it, clamped to the edge, or else its middle and the edge's own direction
// as the normal; such edges are counted. The mesh is closed whatever the rays say.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/solid.hpp"
#include "compute/tile_grid.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

struct TileMesh {
    // One vertex for each smooth piece of surface that meets in a cell: along a sharp edge two vertices share a position and
    // a key and differ in normal and colour.
    std::vector<shared::SurfaceVertex> vertices;
    // Names the point on the surface, the same in all tiles: (cell index in the lattice) * 16 + slot. Slots 0 to 3 are the
    // cell's loops; slot 4 + 2 * axis + pair is the extra vertex on the cell's lower face of that axis (cell_table.hpp).
    std::vector<std::uint64_t> keys;
    std::vector<std::uint32_t> indices;   // three a triangle, counter-clockwise seen from outside
    std::uint32_t disagreeing_edges = 0;  // of this tile's own edges

    [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

// Thread-safe as long as the solid does not change. Reuses the mesh's memory.
void mesh_tile(const Solid& solid, const TileGrid& grid, std::uint32_t tile, TileMesh& mesh);

}  // namespace burin
