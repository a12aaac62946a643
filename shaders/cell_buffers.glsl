// SPDX-License-Identifier: MIT
// The buffers that all shaders share which make cells, and functions that several of them use.
#include "shaders/shared/cell_row.h"
#include "shaders/shared/cell_job.h"
#include "shaders/shared/octahedral.h"

layout(push_constant) uniform Push { CellParameters parameters; };
layout(std430, binding = 0) readonly buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) buffer Counters { CellCounters counters; };
layout(std430, binding = 2) buffer Tiles { CellTile tiles[]; };  // by slot
layout(std430, binding = 3) buffer Masks { TileMask masks[]; };
layout(std430, binding = 4) buffer Cells { ListedCell cells[]; };
layout(std430, binding = 5) buffer Edges { ListedEdge edges[]; };
layout(std430, binding = 6) readonly buffer Tables { uvec4 tables[]; };  // rows of cell_row.h
layout(std430, binding = 7) buffer Hard { uint hard[]; };  // indices into `cells`: those without a closed form
// What the host reads: in its memory, where a card has memory of its own.
layout(std430, binding = 8) writeonly buffer MadeTiles { MadeTile made_tiles[]; };
layout(std430, binding = 9) buffer MadeCells { MadeCell made_cells[]; };
layout(std430, binding = 10) writeonly buffer MadeEdges { MadeEdge made_edges[]; };
layout(std430, binding = 11) writeonly buffer MadeVertices { SurfaceVertex made_vertices[]; };
#include "shaders/dexel_store.glsl"

ivec3 first_node(uint tile) {
    int i = int(tile);
    return kMeshTile * ivec3(i % parameters.tiles[0], i / parameters.tiles[0] % parameters.tiles[1],
                             i / (parameters.tiles[0] * parameters.tiles[1]));
}

int node_column(int x, int y) { return (y + 1) * kMeshNodes + x + 1; }
int cell_column(int x, int y) { return (y + 1) * kMeshCells + x + 1; }
uint below(int z) { return (1u << uint(z + 1)) - 1u; }  // the bits of the heights below z

uint pattern_of(uint cell) { return cell >> 16; }
ivec3 cell_place(uint cell) {
    int id = int(cell & 0xffffu);
    return ivec3(id / kMeshCells % kMeshCells - 1, id / (kMeshCells * kMeshCells) - 1, id % kMeshCells - 1);
}
ivec3 edge_node(uint place) {
    return ivec3(int(place >> 2 & 31u) - 1, int(place >> 7 & 31u) - 1, int(place >> 12 & 31u) - 1);
}
uint edge_place(int axis, ivec3 node, uint inside) {
    return uint(axis) | uint(node.x + 1) << 2 | uint(node.y + 1) << 7 | uint(node.z + 1) << 12 | inside << 17;
}
bool lower_is_inside(uint place) { return (place >> 17 & 1u) != 0u; }

// Returns a ray through the tile's nodes; without ends outside the lattice.
RayRef ray_at(int axis, int u, int v) {
    int rays_u = parameters.nodes[(axis + 1) % 3];
    int rays_v = parameters.nodes[(axis + 2) % 3];
    if (u < 0 || v < 0 || u >= rays_u || v >= rays_v) return RayRef(0u, 0u);
    return rays[parameters.first_ray[axis] + uint(v * rays_u + u)];
}
