// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Numbers the vertices of each tile, cell after cell, and frees the ranges that have become too small or too large. One
// work group per tile. Ranges are only freed here and only allocated in mesh_places.comp, so that the lists need no
// locks.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_ranges.glsl"

layout(local_size_x = 64) in;

shared uint sums[kMeshGroup];

void main() {
    uint slot = gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationID.x;
    uint count = jobs[slot].cells;
    uint share = (count + 63u) / 64u;
    uint from = min(lane * share, count) + jobs[slot].first_cell;
    uint to = min((lane + 1u) * share, count) + jobs[slot].first_cell;
    uint sum = 0u;
    for (uint i = from; i < to; ++i) sum += cells[i].made.w & 0xffffu;
    sums[lane] = sum;
    barrier();
    if (lane == 0u) {
        uint all = 0u;
        for (int i = 0; i < kMeshGroup; ++i) {
            uint of_lane = sums[i];
            sums[i] = all;
            all += of_lane;
        }
        jobs[slot].cell_vertices = all;
        if (jobs[slot].waits == 0u) {
            uint tile = jobs[slot].tile;
            uint vertex_class = class_for(all + jobs[slot].extras);
            uint index_class = class_for(6u * jobs[slot].quads + 3u * jobs[slot].extras);
            if (ranges[tile].vertex_class != vertex_class) {
                give_back(0u, ranges[tile].vertex_class, uint(ranges[tile].first_vertex));
                ranges[tile].vertex_class = kNoClass;
            }
            if (ranges[tile].index_class != index_class) {
                give_back(1u, ranges[tile].index_class, ranges[tile].first_index);
                ranges[tile].index_class = kNoClass;
            }
        }
    }
    barrier();
    uint at = sums[lane];
    for (uint i = from; i < to; ++i) {
        cells[i].made.z = at;
        at += cells[i].made.w & 0xffffu;
    }
}
