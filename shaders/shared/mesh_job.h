// SPDX-License-Identifier: MIT
// What the host and the shaders that mesh on the device (shaders/mesh_*.comp) tell each other. The rules of the mesh are
// those of compute/tile_mesher.hpp; compute/device_surface.hpp says how the work flows. All fields are 32-bit words but for
// those of the push constants, so the layout is the same everywhere.
#ifndef BURIN_SHARED_MESH_JOB_H
#define BURIN_SHARED_MESH_JOB_H
#include "shaders/shared/dexel.h"
#include "shaders/shared/glm_names.h"
#include "shaders/shared/surface_vertex.h"

BURIN_SHARED_BEGIN

// As in compute/tile_grid.hpp and tile_samples.hpp: a tile has 16 cells a side and sees the cells from -1 on and the nodes
// -1 .. 16. A column is all that lies above one (x, y); bit z + 1 of its word stands for z.
const int kMeshTile = 16;
const int kMeshCells = 17;
const int kMeshNodes = 18;
const int kNodeColumns = 324;
const int kCellColumns = 289;
const int kEdgeColumns = 972;  // of the three axes
const int kMeshGroup = 64;     // invocations in a work group
const int kNearEdgeUnits = 256;
const uint kNotOwn = 0xffffffffu;
const uint kNoSlot = 0xffffffffu;

// Ranges of the pools hold a power of two of vertices or indices: 64 of the smallest class, 2^20 of the largest.
const int kRangeClasses = 15;
const uint kNoClass = 0xffffffffu;
BURIN_FN uint class_size(uint range_class) { return uint(64) << range_class; }

// One tile's surface in the pools: what an indirect indexed draw reads, and behind it what the mesher keeps.
struct TileRange {
    uint index_count;
    uint instance_count;
    uint first_index;
    int first_vertex;
    uint first_instance;
    uint vertices;
    uint vertex_class;  // kNoClass: it has no range
    uint index_class;
    uint disagreeing;  // own edges whose rays disagree
    uint marked;       // 1: on the list of tiles to mesh, or of those that wait
};

// A tile while it is meshed. What is read together lies together: software drivers load one word of one invocation after the
// other, so that the shaders' time is the number of loads.
struct TileJob {
    uint tile;
    uint first_cell;
    uint cells;
    uint first_edge;
    uint edges;
    uint quads;
    uint extras;       // vertices on twice passed faces, and as many triangles more than two a quad
    uint extras_made;  // so far
    uint cell_vertices;
    uint waits;  // 1: something has no space for it
    uint disagreeing;
    uint unused;
    uint signs[324];          // of node columns: which nodes are inside
    uvec2 cell_columns[289];  // the cells that quads refer to; where in the list of cells the column's begin
    uvec2
        edge_columns[972];  // of node columns, axis by axis: the crossed edges of these cells; where their list begins
};

struct MeshCell {
    // Slot of its TileJob, kNoSlot: the entry is void; ((y + 1) * kMeshCells + x + 1) * kMeshCells + z + 1, and from bit 16 on
    // which corners are inside; apart from the rest: an entry of the list of cells without a closed form.
    uvec4 what;
    // TileMesh::vertex_of_edge, low and high; its first vertex in the tile; how many, and from bit 16 on the faces that a loop
    // passes twice.
    uvec4 made;
};

struct MeshEdge {
    // Slot, likewise; axis, in 5 bits each x + 1, y + 1, z + 1 of the lower node, and in bit 17 whether that is inside; the
    // quad's number in the tile, kNotOwn when the edge is another tile's; colour, and in the high 8 bits material.
    uvec4 what;
    vec4 crossing;  // normal; 0 at the lower node, 1 at the upper
};

struct MeshCounters {
    uint tile_groups[3];  // what indirect dispatches read: a group a tile, 64 edges, 64 cells
    uint edge_groups[3];
    uint cell_groups[3];
    uint hard_groups[3];  // likewise of cells without a closed form
    uint fan_groups[3];   // of edges, when there is any fan
    uint tiles;           // to mesh
    uint waiting;         // length of the list of tiles that could not be meshed
    uint cells;
    uint edges;
    uint vertices_used;  // of the pools, or more when a range was asked for in vain
    uint indices_used;
    uint triangles;       // made
    uint ball_triangles;  // within the ball, also when there is no space for them
    uint ball_vertices;
    uint hard_cells;  // length of their list
};

struct MeshParameters {
    uint64_t store_address;
    uint64_t vertex_address;
    uint64_t index_address;
    double spacing_m;
    int nodes[3];
    int tiles[3];
    uint first_ray[3];
    uint slots;
    uint most_cells;
    uint most_edges;
    uint most_vertices;
    uint most_indices;
    uint most_free;  // free ranges that are remembered, of each class
};

struct GatherParameters {
    uint64_t vertex_address;
    uint64_t index_address;
    uint64_t member_address;
    double center[3];  // metres, relative to the lattice's origin
    float center_float[3];
    float radius_m;
    int tiles[3];
    int from[3];  // the tiles to look at
    int count[3];
    uint stamp;  // another one for each ball
    float spacing_m;
};

const int kBallVertices = 32768;  // of the triangles near the tool; with more the ball is made smaller
const int kBallTriangles = 65536;

BURIN_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(burin::shared::TileRange) == 40 && sizeof(burin::shared::MeshCell) == 32 &&
              sizeof(burin::shared::MeshEdge) == 32 && sizeof(burin::shared::MeshCounters) == 100 &&
              sizeof(burin::shared::TileJob) == 4 * (12 + 324 + 2 * 289 + 2 * 972) &&
              sizeof(burin::shared::MeshParameters) == 96 && sizeof(burin::shared::GatherParameters) == 112);
#endif
#endif
