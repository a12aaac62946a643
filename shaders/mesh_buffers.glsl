// SPDX-License-Identifier: MIT
// The buffers that all shaders of the mesher share, and what several of them ask.
#include "shaders/shared/mesh_job.h"
#include "shaders/shared/octahedral.h"

layout(push_constant) uniform Push { MeshParameters parameters; };
layout(std430, binding = 0) readonly buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) buffer Counters { MeshCounters counters; };
layout(std430, binding = 2) buffer Ranges { TileRange ranges[]; };
layout(std430, binding = 3) buffer Dirty { uint dirty[]; };      // tiles to mesh
layout(std430, binding = 4) writeonly buffer Waiting { uint waiting[]; };
layout(std430, binding = 5) buffer Jobs { TileJob jobs[]; };     // of these tiles
layout(std430, binding = 6) buffer Cells { MeshCell cells[]; };
layout(std430, binding = 7) buffer Edges { MeshEdge edges[]; };
layout(std430, binding = 8) buffer Free { uint free_places[]; };  // counts of both pools' classes, then their lists
layout(std430, binding = 9) readonly buffer Tables { uvec4 tables[]; };  // see listed_edge
#include "shaders/dexel_store.glsl"

layout(buffer_reference, std430, buffer_reference_align = 4) buffer Vertices { SurfaceVertex at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Indices { uint at[]; };
Vertices pool_vertices = Vertices(parameters.vertex_address);
Indices pool_indices = Indices(parameters.index_address);

ivec3 first_node(uint tile) {
    int i = int(tile);
    return kMeshTile * ivec3(i % parameters.tiles[0], i / parameters.tiles[0] % parameters.tiles[1],
                             i / (parameters.tiles[0] * parameters.tiles[1]));
}

int node_column(int x, int y) { return (y + 1) * kMeshNodes + x + 1; }
int cell_column(int x, int y) { return (y + 1) * kMeshCells + x + 1; }
uint below(int z) { return (1u << uint(z + 1)) - 1u; }  // the bits of what lies below z

uint cell_pattern(uint slot, ivec3 cell) {
    int column = node_column(cell.x, cell.y);
    uint shift = uint(cell.z + 1);
    uint p00 = jobs[slot].signs[column] >> shift;
    uint p10 = jobs[slot].signs[column + 1] >> shift;
    uint p01 = jobs[slot].signs[column + kMeshNodes] >> shift;
    uint p11 = jobs[slot].signs[column + kMeshNodes + 1] >> shift;
    return (p00 & 1u) | (p10 & 1u) << 1 | (p01 & 1u) << 2 | (p11 & 1u) << 3 |
           (p00 >> 1 & 1u) << 4 | (p10 >> 1 & 1u) << 5 | (p01 >> 1 & 1u) << 6 | (p11 >> 1 & 1u) << 7;
}

// cell_table.hpp, a row a pattern: edges[0 .. 7] in 4 bits each; edges[8 .. 11] and first_edge[1 .. 4]; loops and twice_faces.
// And in the last word the colour of the material of that number.
uint listed_edge(uvec4 row, uint i) { return (i < 8u ? row.x : row.y) >> (4u * (i & 7u)) & 0xfu; }
uint first_listed(uvec4 row, uint loop) { return loop == 0u ? 0u : row.y >> (12u + 4u * loop) & 0xfu; }
uint loops_of(uvec4 row) { return row.z & 0xfu; }
uint twice_faces(uvec4 row) { return row.z >> 4; }

ivec3 along_axis(int axis, int by) { return ivec3(axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0); }

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

// The lower node of a cell's edge, from the cell's lowest.
ivec3 edge_offset(uint edge) {
    int axis = int(edge >> 2);
    return along_axis((axis + 1) % 3, int(edge & 1u)) + along_axis((axis + 2) % 3, int(edge >> 1 & 1u));
}
uint sample_of(uint slot, ivec3 cell, uint edge) { return edge_number(slot, int(edge >> 2), cell + edge_offset(edge)); }

// The ends of a ray through the tile's nodes; none outside the lattice.
RayRef ray_at(int axis, int u, int v) {
    int rays_u = parameters.nodes[(axis + 1) % 3];
    int rays_v = parameters.nodes[(axis + 2) % 3];
    if (u < 0 || v < 0 || u >= rays_u || v >= rays_v) return RayRef(0u, 0u);
    return rays[parameters.first_ray[axis] + uint(v * rays_u + u)];
}

// Component by component and in this order, as the host computes it.
float dot3(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}
vec3 cross3(vec3 a, vec3 b) {
    precise vec3 c = vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return c;
}
