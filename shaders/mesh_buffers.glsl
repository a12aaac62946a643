// SPDX-License-Identifier: MIT
// The buffers that all shaders of the mesher share, and functions that several of them use.
#include "shaders/shared/cell_quad.h"
#include "shaders/shared/mesh_job.h"
#include "shaders/shared/octahedral.h"

layout(push_constant) uniform Push { MeshParameters parameters; };
layout(std430, binding = 0) readonly buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) buffer Counters { MeshCounters counters; };
layout(std430, binding = 2) buffer Ranges { TileRange ranges[]; };
layout(std430, binding = 3) buffer Dirty { uint dirty[]; };      // tiles to mesh
layout(std430, binding = 4) writeonly buffer Waiting { uint waiting[]; };
layout(std430, binding = 5) buffer Jobs { TileJob jobs[]; };     // jobs of the dirty tiles
layout(std430, binding = 6) buffer Cells { MeshCell cells[]; };
layout(std430, binding = 7) buffer Edges { MeshEdge edges[]; };
layout(std430, binding = 8) buffer Free { uint free_places[]; };  // counts of both pools' classes, then their lists
layout(std430, binding = 9) readonly buffer Tables { uvec4 tables[]; };  // rows of cell_row.h
// Indices into `cells`: those to make from the front on, those to copy from the end on backwards.
layout(std430, binding = 10) buffer Lists { uint lists[]; };
// Quads to copy. x: slot, or kNoSlot for a void entry; y: edge_place, and from bit 18 on the quad's number in the tile.
layout(std430, binding = 11) buffer KeptQuads { uvec2 kept_quads[]; };
layout(std430, binding = 12) buffer Masks { TileMask masks[]; };
layout(std430, binding = 13) buffer Hard { uint hard[]; };  // indices into `cells`: those without a closed form
#include "shaders/dexel_store.glsl"

layout(buffer_reference, std430, buffer_reference_align = 4) buffer Vertices { SurfaceVertex at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Indices { uint at[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) buffer KeptCells { uvec4 at[]; };
Vertices pool_vertices = Vertices(parameters.vertex_address);
Indices pool_indices = Indices(parameters.index_address);
KeptCells pool_kept = KeptCells(parameters.kept_address);

ivec3 first_node(uint tile) {
    int i = int(tile);
    return kMeshTile * ivec3(i % parameters.tiles[0], i / parameters.tiles[0] % parameters.tiles[1],
                             i / (parameters.tiles[0] * parameters.tiles[1]));
}

int node_column(int x, int y) { return (y + 1) * kMeshNodes + x + 1; }
int cell_column(int x, int y) { return (y + 1) * kMeshCells + x + 1; }
uint below(int z) { return (1u << uint(z + 1)) - 1u; }  // the bits of the heights below z

uint cell_pattern(uint slot, ivec3 cell) {
    int column = node_column(cell.x, cell.y);
    return corner_pattern(jobs[slot].signs[column], jobs[slot].signs[column + 1], jobs[slot].signs[column + kMeshNodes],
                          jobs[slot].signs[column + kMeshNodes + 1], uint(cell.z + 1));
}

uint edge_number(uint slot, int axis, ivec3 node) {
    uvec2 column = jobs[slot].edge_columns[axis * kNodeColumns + node_column(node.x, node.y)];
    return column.y + uint(bitCount(column.x & below(node.z)));
}
uint cell_number(uint slot, ivec3 cell) {
    uvec2 column = jobs[slot].cell_columns[cell_column(cell.x, cell.y)];
    return column.y + uint(bitCount(column.x & below(cell.z)));
}
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

// Keeps what the tile's next mesh may copy of a cell; `number` is the cell's index in `cells`.
void keep_cell(uint slot, uint first_vertex, uint number, uint what, uvec4 made) {
    pool_kept.at[first_vertex + number - jobs[slot].first_cell] =
        uvec4(made.x, made.y, made.z | what << 16, made.w);
}
// Returns the vertex of one of the cell's edges, from MeshCell::made.
uint vertex_of(uvec4 made, uint edge) {
    return made.z + ((edge < 8u ? made.x : made.y) >> (4u * (edge & 7u)) & 0xfu);
}

// Returns the lower node of a cell's edge, relative to the cell's lowest node.
ivec3 edge_offset(uint edge) {
    int axis = axis_of_edge(edge);
    return along_axis((axis + 1) % 3, first_offset(edge)) + along_axis((axis + 2) % 3, second_offset(edge));
}
uint sample_of(uint slot, ivec3 cell, uint edge) {
    return edge_number(slot, axis_of_edge(edge), cell + edge_offset(edge));
}

// Returns a ray through the tile's nodes; without ends outside the lattice.
RayRef ray_at(int axis, int u, int v) {
    int rays_u = parameters.nodes[(axis + 1) % 3];
    int rays_v = parameters.nodes[(axis + 2) % 3];
    if (u < 0 || v < 0 || u >= rays_u || v >= rays_v) return RayRef(0u, 0u);
    return rays[parameters.first_ray[axis] + uint(v * rays_u + u)];
}
