// SPDX-License-Identifier: MIT
// What a device tells the host of the cells that it has made anew after a cut (shaders/make_cells.comp), by tile. The
// host puts them into its tiles (compute/mesher/made_cells.hpp). A cell, its vertices and the crossings of its edges
// are those of compute/mesher/tile_mesher.hpp, bit for bit. All fields are 32-bit words, so the layout is the same
// everywhere.
#ifndef BURIN_SHARED_MADE_CELLS_H
#define BURIN_SHARED_MADE_CELLS_H
#include "shaders/shared/portable.h"

BURIN_SHARED_BEGIN

struct MadeTile {
    uint tile;
    uint left;  // 1: the host is to mesh it: a list had no room for it
    uint first_cell;  // of the list of made cells; in increasing order of their numbers
    uint cells;
    uint first_edge;  // of the list of crossings; in increasing order of their numbers
    uint edges;
    uint signs[324];  // inside bits of the columns of nodes that it sees, (y + 1) * kMeshNodes + x + 1
};

struct MadeCell {
    uint what;  // number of the cell in 16 bits, ((y + 1) * kMeshCells + x + 1) * kMeshCells + z + 1; then its vertices
    uint first_vertex;  // of the list of vertices
    uint of_edge_low;   // TileMesh::vertex_of_edge, low and high word
    uint of_edge_high;
};

// A crossed edge that the tile owns, beside one of its made cells. Its quad is to be made anew.
struct MadeEdge {
    uint what;    // number of the edge as in SurfaceTile::quads, with kDisagrees; bit 16: its lower node is inside
    uint normal;  // of the crossing, as in octahedral.h
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::MadeTile) == 4 * (6 + 324) && sizeof(burin::shared::MadeCell) == 16 &&
              sizeof(burin::shared::MadeEdge) == 8);
#endif
#endif
