// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Counts the vertices of each cell and assigns them to its crossed edges: one for each smooth piece of each loop of
// surface (shaders/shared/cell_pieces.h). Also counts the extra vertices of faces that a loop passes twice. One
// invocation per cell that is made anew.
#include "shaders/mesh_buffers.glsl"
#include "shaders/shared/cell_vertex.h"

layout(local_size_x = 64) in;

#include "shaders/shared/cell_pieces.h"

bool own_node(ivec3 node) { return all(greaterThanEqual(node, ivec3(0))) && all(lessThan(node, ivec3(kMeshTile))); }

// Returns how many of the four edges of the cell's lower face the tile owns: each adds a vertex there.
uint own_edges_of_face(ivec3 cell, int axis) {
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    uint at_cell = own_node(cell) ? 2u : 0u;
    return at_cell + (own_node(cell + along_axis(u, 1)) ? 1u : 0u) + (own_node(cell + along_axis(v, 1)) ? 1u : 0u);
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= counters.made_cells) return;
    number = lists[number];
    uvec4 what = cells[number].what;
    uint slot = what.x;
    ivec3 cell = cell_place(what.y);
    uvec4 row = tables[pattern_of(what.y)];
    uint loops = loops_of(row);
    uint low = 0xffffffffu;
    uint high = 0xffffffffu;
    uint vertices = 0u;
    for (uint loop = 0u; loop < loops; ++loop) {
        uint last = first_listed(row, loop + 1u);
        pieces = 0u;
        if (loop > 0u) high = (high & ~(0xfu << (16u + 4u * loop))) | vertices << (16u + 4u * loop);
        for (uint i = first_listed(row, loop); i < last; ++i) {
            uint edge = listed_edge(row, i);
            uint crossing = sample_of(slot, cell, edge);
            uint p = piece_of(edges[crossing].crossing.xyz, edges[crossing].what.w >> 24);
            uint shift = 4u * (edge & 7u);
            uint used = (vertices + p) << shift;
            low = edge < 8u ? (low & ~(0xfu << shift)) | used : low;
            high = edge < 8u ? high : (high & ~(0xfu << shift)) | used;
        }
        vertices += pieces;
    }
    uint twice = twice_faces_of(row);
    cells[number].made = uvec4(low, high, 0u, vertices | twice << 16);
    for (uint face = 0u; face < (twice == 0u ? 0u : 6u); face += 2u) {  // the cell's lower faces
        int axis = int(face >> 1);
        ivec3 next = cell - along_axis(axis, 1);
        if ((twice >> face & 1u) == 0u || next[axis] < -1) continue;
        if ((twice_faces_of(tables[cell_pattern(slot, next)]) >> (face + 1u) & 1u) == 0u) continue;
        atomicAdd(jobs[slot].extras, own_edges_of_face(cell, axis));
        counters.fan_groups[0] = counters.edge_groups[0];
    }
}
