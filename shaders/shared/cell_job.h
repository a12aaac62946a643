// SPDX-License-Identifier: MIT
// The interface between the host and the shaders that make the cells which a cut can have altered (mark_cells.comp,
// list_cells.comp, find_crossings.comp, make_cells.comp). compute/vulkan/cell_maker.hpp describes the flow of work, and
// shaders/shared/made_cells.h what comes of it. All fields are 32-bit words, except those of the push constants, so the
// layout is the same everywhere.
#ifndef BURIN_SHARED_CELL_JOB_H
#define BURIN_SHARED_CELL_JOB_H
#include "shaders/shared/dexel.h"
#include "shaders/shared/glm_names.h"
#include "shaders/shared/made_cells.h"
#include "shaders/shared/mesh_tile.h"
#include "shaders/shared/surface_vertex.h"

BURIN_SHARED_BEGIN

const int kNodeColumns = 324;
const int kCellColumns = 289;
const int kCellGroup = 64;  // invocations in a work group
const uint kNotOwn = 0xffffffffu;
const uint kNoSlot = 0xffffffffu;

// A row of the table of marked cells, which is addressed by a hash of the tile: whoever marks a cell finds the row
// without waiting for the one who took it.
struct TileMask {
    uint key;  // 1 + the tile; 0: free
    uint columns[289];
};

// A tile while its cells are made. Values that are read together are stored together: software drivers load one word of
// one invocation after the other, so the number of loads determines the shaders' time.
struct CellTile {
    uint tile;
    uint mask;  // row of its marked cells
    // For each node column, axis by axis: the crossed edges of the cells to make; index of the first of them in the
    // list of edges.
    uvec2 edge_columns[972];
};

// x: slot of its CellTile, or kNoSlot for a void entry; y: its number as in MadeCell, and from bit 16 on which corners
// are inside.
struct ListedCell {
    uvec2 what;
};

struct ListedEdge {
    // x: slot, or kNoSlot for a void entry. y: axis, in 5 bits each x + 1, y + 1, z + 1 of the lower node, and whether
    // that node is inside in bit 17. z: its place in the list of MadeEdges, or kNotOwn when another tile owns the edge.
    // w: colour, and in the high 8 bits material.
    uvec4 what;
    vec4 crossing;  // xyz: normal; w: 0 at the lower node, 1 at the upper
};

struct CellCounters {
    // Group counts that indirect dispatches read: one group per tile, per 64 edges, per 64 cells.
    uint tile_groups[3];
    uint edge_groups[3];
    uint cell_groups[3];
    uint hard_groups[3];  // group counts for cells without a closed form
    // Numbers of what was listed, also where there was no room for it.
    uint tiles;
    uint missed;  // how often a cell could not be marked: its tile got no slot, or no row
    uint cells;
    uint edges;
    uint own_edges;
    uint vertices;
    uint hard_cells;
};

struct CellParameters {
    uint64_t store_address;
    double spacing_m;
    int nodes[3];
    int tiles[3];
    uint first_ray[3];
    uint slots;
    uint most_cells;
    uint most_edges;
    uint most_own_edges;
    uint most_vertices;
    uint mask_rows;  // a power of two
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::CellTile) == 4 * (2 + 2 * 972) && sizeof(burin::shared::ListedEdge) == 32 &&
              sizeof(burin::shared::CellCounters) == 76 && sizeof(burin::shared::CellParameters) == 80);
#endif
#endif
