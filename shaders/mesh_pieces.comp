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

bool in_one_piece(vec3 first_normal, uint first_material, vec3 normal, uint material) {
    return dot3(first_normal, normal) >= (first_material == material ? kSmooth : kSmoothAcrossMaterials);
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
    uvec4 what = cells[number].what;
    uint slot = what.x;
    if (slot == kNoSlot) return;
    ivec3 cell = cell_place(what.y);
    uvec4 row = tables[pattern_of(what.y)];
    uint loops = loops_of(row);
    uint low = 0xffffffffu;
    uint high = 0xffffffffu;
    uint vertices = 0u;
    vec3 first_normal[12];  // of each piece of the loop
    uint first_material[12];
    for (uint loop = 0u; loop < loops; ++loop) {
        uint pieces = 0u;
        uint last = first_listed(row, loop + 1u);
        vec3 normal_0 = vec3(0.0);  // of the first piece, which is mostly the only one
        uint material_0 = 0u;
        if (loop > 0u) high = (high & ~(0xfu << (16u + 4u * loop))) | vertices << (16u + 4u * loop);
        for (uint i = first_listed(row, loop); i < last; ++i) {
            uint edge = listed_edge(row, i);
            uint crossing = sample_of(slot, cell, edge);
            vec3 normal = edges[crossing].crossing.xyz;
            uint material = edges[crossing].what.w >> 24;
            uint p = 0u;
            if (pieces == 0u) {
                normal_0 = normal;
                material_0 = material;
                pieces = 1u;
            } else if (!in_one_piece(normal_0, material_0, normal, material)) {
                p = 1u;
                while (p < pieces && !in_one_piece(first_normal[p], first_material[p], normal, material)) ++p;
                if (p == pieces) {
                    first_normal[p] = normal;
                    first_material[p] = material;
                    ++pieces;
                }
            }
            uint shift = 4u * (edge & 7u);
            uint used = (vertices + p) << shift;
            low = edge < 8u ? (low & ~(0xfu << shift)) | used : low;
            high = edge < 8u ? high : (high & ~(0xfu << shift)) | used;
        }
        vertices += pieces;
    }
    uint twice = twice_faces(row);
    cells[number].made = uvec4(low, high, 0u, vertices | twice << 16);
    for (uint face = 0u; face < (twice == 0u ? 0u : 6u); face += 2u) {  // the cell's lower faces
        int axis = int(face >> 1);
        ivec3 next = cell - along_axis(axis, 1);
        if ((twice >> face & 1u) == 0u || next[axis] < -1) continue;
        if ((twice_faces(tables[cell_pattern(slot, next)]) >> (face + 1u) & 1u) == 0u) continue;
        atomicAdd(jobs[slot].extras, own_edges_of_face(cell, axis));
        counters.fan_groups[0] = counters.edge_groups[0];
    }
}
