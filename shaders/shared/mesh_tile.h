// SPDX-License-Identifier: MIT
// The part of the lattice that a tile of the mesh sees, and its encoding in bits. compute/mesher/tile_mesher.hpp
// describes the mesh.
//
// A tile has kMeshTile cells a side. It owns the nodes 0 .. kMeshTile - 1 and the lattice edges that start at them; it
// sees the cells from -1 on and the nodes -1 .. kMeshTile. A column is all that lies above one (x, y); bit z + 1 of its
// word belongs to height z.
#ifndef BURIN_SHARED_MESH_TILE_H
#define BURIN_SHARED_MESH_TILE_H
#include "shaders/shared/dexel.h"
#include "shaders/shared/glm_names.h"

BURIN_SHARED_BEGIN

const int kMeshTile = 16;
const int kMeshCells = 17;
const int kMeshNodes = 18;
const uint kOwnNodes = 0x1fffeu;  // bits of the tile's own nodes in a column

// How far beyond an edge its crossing may lie, in lattice units (1/16 of a cell). Where the rays of a solid disagree
// about a node, they do so by the rounding of a depth, one unit; what lies farther off is another surface.
const int kNearEdge = 256;
const uint kNoEnd = 0xffffffffu;  // no end of the ray is near the edge

// Returns the crossed z edges of a column of nodes; the highest node has no edge upwards.
BURIN_FN uint crossed_upwards(uint nodes) { return (nodes ^ (nodes >> 1)) & ((1u << uint(kMeshNodes - 1)) - 1u); }
// Returns the cells of a column that touch edges along its sides: an edge along x or y at height z touches the cells z
// and z - 1.
BURIN_FN uint cells_beside_edges(uint level, uint upright) { return level | level >> 1 | upright; }
// Returns the heights of the edges along x or y of these cells.
BURIN_FN uint level_edges_of(uint cells) { return cells | cells << 1; }

// Returns which corners of a cell are inside (bit c: corner c of compute/mesher/cell_table.hpp), from the columns of
// nodes at (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1), and the bit of the cell's height.
BURIN_HOT_FN uint corner_pattern(uint column00, uint column10, uint column01, uint column11, uint bit) {
    uint p00 = column00 >> bit;
    uint p10 = column10 >> bit;
    uint p01 = column01 >> bit;
    uint p11 = column11 >> bit;
    uint lower = (p00 & 1u) | (p10 & 1u) << 1 | (p01 & 1u) << 2 | (p11 & 1u) << 3;
    return lower | (p00 & 2u) << 3 | (p10 & 2u) << 4 | (p01 & 2u) << 5 | (p11 & 2u) << 6;
}

// Returns the cell in which a depth lies along its ray; -1 is the empty layer below the first.
BURIN_FN int cell_at_depth(int depth) { return ((depth + kUnitsPerCell) >> kSubcellBits) - 1; }

struct CellRange {
    int lo[3];
    int hi[3];
};

// Returns the cells that a change of ray (u, v) between two depths can have altered: those around the ray, over the
// depths that changed, extended by the distance that a crossing may lie beyond its edge. A cell's vertices depend on
// nothing else.
BURIN_HOT_FN CellRange cells_changed(int axis, int u, int v, int changed_lo, int changed_hi) {
    int s_lo = cell_at_depth(changed_lo - kNearEdge);
    int s_hi = cell_at_depth(changed_hi + kNearEdge);
    CellRange range;
    range.lo[0] = axis == 0 ? s_lo : (axis == 1 ? v - 1 : u - 1);
    range.lo[1] = axis == 0 ? u - 1 : (axis == 1 ? s_lo : v - 1);
    range.lo[2] = axis == 0 ? v - 1 : (axis == 1 ? u - 1 : s_lo);
    range.hi[0] = axis == 0 ? s_hi : (axis == 1 ? v : u);
    range.hi[1] = axis == 0 ? u : (axis == 1 ? s_hi : v);
    range.hi[2] = axis == 0 ? v : (axis == 1 ? u : s_hi);
    return range;
}

// Returns the part of a range that a tile sees, in cells from its lowest node; empty where hi < lo along an axis.
BURIN_FN CellRange cells_seen(CellRange cells, int tile_x, int tile_y, int tile_z) {
    CellRange seen;
    for (int a = 0; a < 3; ++a) {
        int first = kMeshTile * (a == 0 ? tile_x : (a == 1 ? tile_y : tile_z));
        seen.lo[a] = cells.lo[a] - first < -1 ? -1 : cells.lo[a] - first;
        seen.hi[a] = cells.hi[a] - first > kMeshTile - 1 ? kMeshTile - 1 : cells.hi[a] - first;
    }
    return seen;
}
// Returns the bits of the cells from height lo to height hi of a column; lo <= hi.
BURIN_HOT_FN uint cells_between(int lo, int hi) { return (2u << uint(hi + 1)) - (1u << uint(lo + 1)); }

BURIN_SHARED_END
#endif
