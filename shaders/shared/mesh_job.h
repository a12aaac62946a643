// SPDX-License-Identifier: MIT
// The interface between the host and the shaders that mesh on the device (shaders/mesh_*.comp). The rules of the mesh
// are those of compute/mesher/tile_mesher.hpp; compute/vulkan/device_surface.hpp describes the flow of work. All fields
// are 32-bit words, except those of the push constants, so the layout is the same everywhere.
#ifndef BURIN_SHARED_MESH_JOB_H
#define BURIN_SHARED_MESH_JOB_H
#include "shaders/shared/dexel.h"
#include "shaders/shared/glm_names.h"
#include "shaders/shared/mesh_tile.h"
#include "shaders/shared/surface_vertex.h"

BURIN_SHARED_BEGIN

const int kNodeColumns = 324;
const int kCellColumns = 289;
const int kEdgeColumns = 972;  // node columns of all three axes
const int kMeshGroup = 64;     // invocations in a work group
const uint kNotOwn = 0xffffffffu;
const uint kNoSlot = 0xffffffffu;

// A range of a pool holds a power of two of vertices or indices: 64 in the smallest class, 2^20 in the largest.
const int kRangeClasses = 15;
const uint kNoClass = 0xffffffffu;
BURIN_FN uint class_size(uint range_class) { return uint(64) << range_class; }

// One tile's surface in the pools: first the words that an indirect indexed draw reads, then those of the mesher.
struct TileRange {
    uint index_count;
    uint instance_count;
    uint first_index;
    int first_vertex;
    uint first_instance;
    uint vertices;
    uint vertex_class;  // kNoClass: no range
    uint index_class;
    uint disagreeing;  // number of own edges whose rays disagree
    uint marked;       // 1: on the list of waiting tiles, to be meshed whole
    uint cells;        // with vertices; the first as many KeptCells of the range are theirs
    uint twice;        // 1: a loop passes a face of one of them twice
};

// A row of the table of marked cells, which is addressed by a hash of the tile: whoever marks a cell finds the row
// without waiting for the one who took it.
struct TileMask {
    uint key;  // 1 + the tile; 0: free
    uint columns[289];
};

// A tile while it is meshed. Values that are read together are stored together: software drivers load one word of one
// invocation after the other, so the number of loads determines the shaders' time.
struct TileJob {
    uint tile;
    uint first_cell;
    uint cells;
    uint made;        // number of these cells whose vertices are made anew
    uint first_edge;  // of the edges of those cells
    uint edges;
    uint quads;
    uint extras;       // vertices on twice passed faces; each adds one triangle to the two of a quad
    uint extras_made;  // number of extras written so far
    uint cell_vertices;
    uint waits;  // 1: a list or a pool has no space for the tile
    uint disagreeing;
    uint mask;  // row of its marked cells; that of a tile meshed whole has none
    // The ranges that the tile had before, or got in vain: given back when nothing is copied from them any more.
    uint old_vertex;
    uint old_vertex_class;
    uint old_index;
    uint old_index_class;
    uint unused;
    uint signs[324];  // inside bits of the node columns
    // For each cell column: the cells that quads refer to; index of the first of them in the list of cells.
    uvec2 cell_columns[289];
    // For each node column, axis by axis: the crossed edges of the cells made anew; index of the first of them in the
    // list of edges.
    uvec2 edge_columns[972];
};

struct MeshCell {
    // x: slot of its TileJob. y: ((y + 1) * kMeshCells + x + 1) * kMeshCells + z + 1, and from bit 16 on which corners
    // are inside. z: of a kept cell, its first vertex in the old range.
    uvec4 what;
    // x, y: TileMesh::vertex_of_edge, low and high word. z: its first vertex in the tile. w: number of vertices in 8
    // bits; from bit kOtherDiagonals and kDisagreements on, a bit for each quad that is kept, by the axis of the edge
    // from the cell's lowest node; from bit 16 on the faces that a loop passes twice.
    uvec4 made;
};
// What a range holds of a cell for the tile's next mesh is a uvec4, MeshCell::made, with the cell's number (as in
// MeshCell::what) from bit 16 of z on, and in w the bits of all its quads.
const uint kOtherDiagonals = 8u;
const uint kDisagreements = 12u;
BURIN_FN uint vertices_in(uint made_w) { return made_w & 0xffu; }

struct MeshEdge {
    // x: slot, or kNoSlot for a void entry. y: axis, in 5 bits each x + 1, y + 1, z + 1 of the lower node, in bit 17
    // whether that node is inside, and in bit 18 whether its rays disagree. z: number of the quad in the tile, or
    // kNotOwn when another tile owns the edge. w: colour, and in the high 8 bits material.
    uvec4 what;
    vec4 crossing;  // xyz: normal; w: 0 at the lower node, 1 at the upper
};

struct MeshCounters {
    // Group counts that indirect dispatches read: one group per tile, per 64 edges, per 64 cells.
    uint tile_groups[3];
    uint edge_groups[3];
    uint cell_groups[3];
    uint hard_groups[3];  // group counts for cells without a closed form
    uint fan_groups[3];   // group counts over the edges; zero unless there is a fan
    uint copy_groups[3];  // group counts over the kept cells
    uint quad_groups[3];  // group counts over the kept quads
    uint tiles;           // number of tiles to mesh
    uint waiting;         // length of the list of tiles that could not be meshed
    uint cells;
    uint edges;
    uint vertices_used;  // allocated in the pools; exceeds the pool size when an allocation failed
    uint indices_used;
    uint triangles;       // number of triangles made
    uint ball_triangles;  // number within the ball, also when there is no space for them
    uint ball_vertices;
    uint hard_cells;  // length of the list of cells without a closed form
    uint made_cells;  // length of the list of cells to make, and
    uint kept_cells;  // of those to copy
    uint kept_quads;
    uint meshed_cells;  // made in tiles that did not have to wait
};

struct MeshParameters {
    uint64_t store_address;
    uint64_t vertex_address;
    uint64_t index_address;
    uint64_t kept_address;
    double spacing_m;
    int nodes[3];
    int tiles[3];
    uint first_ray[3];
    uint slots;
    uint most_cells;
    uint most_edges;
    uint most_vertices;
    uint most_indices;
    uint most_free;  // capacity of each class' list of free ranges
    uint whole;      // so many tiles at the front of the list are meshed whole
    uint mask_rows;  // a power of two
};

struct GatherParameters {
    uint64_t vertex_address;
    uint64_t index_address;
    uint64_t member_address;
    double center[3];  // metres, relative to the lattice's origin
    float center_float[3];
    float radius_m;
    int tiles[3];
    int from[3];  // the block of tiles that may meet the ball
    int count[3];
    uint stamp;  // different for each ball
    float spacing_m;
    uint most_triangles;  // capacity for the triangles near the tool
    uint most_vertices;
};

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::TileRange) == 48 && sizeof(burin::shared::MeshCell) == 32 &&
              sizeof(burin::shared::MeshEdge) == 32 && sizeof(burin::shared::MeshCounters) == 140 &&
              sizeof(burin::shared::TileJob) == 4 * (18 + 324 + 2 * 289 + 2 * 972) &&
              sizeof(burin::shared::MeshParameters) == 112 && sizeof(burin::shared::GatherParameters) == 120);
#endif
#endif
