// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// How many vertices a cell has, and which of them each crossed edge uses: one for each smooth piece of each loop of surface
// (compute/cell_vertices.cpp). And how many extra vertices the faces need that a loop passes twice. One invocation a cell.
#include "shaders/mesh_buffers.glsl"
#include "shaders/shared/feature_constants.h"

layout(local_size_x = 64) in;

bool in_one_piece(uint first, uint other) {
    bool same = ((edges[first].material_disagrees ^ edges[other].material_disagrees) & 0xffu) == 0u;
    return dot3(normal_of(first), normal_of(other)) >= (same ? kSmooth : kSmoothAcrossMaterials);
}

bool own_node(ivec3 node) { return all(greaterThanEqual(node, ivec3(0))) && all(lessThan(node, ivec3(kMeshTile))); }

// How many of the four edges of the cell's lower face are the tile's own: each adds a vertex there.
uint own_edges_of_face(ivec3 cell, int axis) {
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    uint at_cell = own_node(cell) ? 2u : 0u;
    return at_cell + (own_node(cell + along_axis(u, 1)) ? 1u : 0u) + (own_node(cell + along_axis(v, 1)) ? 1u : 0u);
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    uint end_of_list = min(counters.cells, parameters.most_cells);
    if (number >= end_of_list) return;
    uint slot = cells[number].slot;
    if (slot == kNoSlot) return;
    ivec3 cell = cell_place(cells[number].cell);
    uint pattern = cell_pattern(slot, cell);
    uint loops = loops_of(pattern);
    uint low = 0xffffffffu;
    uint high = 0xffffffffu;
    uint vertices = 0u;
    uint first_of[12];
    for (uint loop = 0u; loop < loops; ++loop) {
        uint pieces = 0u;
        uint last = first_listed(pattern, loop + 1u);
        if (loop > 0u) high = (high & ~(0xfu << (16u + 4u * loop))) | vertices << (16u + 4u * loop);
        for (uint i = first_listed(pattern, loop); i < last; ++i) {
            uint edge = listed_edge(pattern, i);
            uint crossing = sample_of(slot, cell, edge);
            uint p = 0u;
            while (p < pieces && !in_one_piece(first_of[p], crossing)) ++p;
            if (p == pieces) first_of[pieces++] = crossing;
            uint shift = 4u * (edge & 7u);
            uint used = (vertices + p) << shift;
            low = edge < 8u ? (low & ~(0xfu << shift)) | used : low;
            high = edge < 8u ? high : (high & ~(0xfu << shift)) | used;
        }
        vertices += pieces;
    }
    cells[number].used_low = low;
    cells[number].used_high = high;
    cells[number].vertices = vertices;
    uint twice = twice_faces(pattern);
    for (uint face = 0u; face < (twice == 0u ? 0u : 6u); face += 2u) {  // the cell's lower faces
        int axis = int(face >> 1);
        ivec3 next = cell - along_axis(axis, 1);
        if ((twice >> face & 1u) == 0u || next[axis] < -1) continue;
        if ((twice_faces(cell_pattern(slot, next)) >> (face + 1u) & 1u) == 0u) continue;
        atomicAdd(jobs[slot].extras, own_edges_of_face(cell, axis));
        counters.fan_groups[0] = counters.edge_groups[0];
    }
}
