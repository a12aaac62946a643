// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Allocates a range of each pool for the tiles that need one and writes the tile's draw command: one invocation per
// tile. A tile that finds no range, or had no space in an earlier stage, is added to the list of waiting tiles; until
// the host has enlarged the list or pool that was too small, it is drawn as before, or not at all if its range is gone.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_ranges.glsl"

layout(local_size_x = 1) in;

const uint kNoPlace = 0xffffffffu;

uint take(uint pool, uint range_class) {
    uint list = list_of(pool, range_class);
    int left = int(atomicAdd(free_places[list], 0xffffffffu));
    if (left > 0) return free_places[places_of(list) + uint(left) - 1u];
    atomicAdd(free_places[list], 1u);
    uint size = class_size(range_class);
    uint place = pool == 0u ? atomicAdd(counters.vertices_used, size) : atomicAdd(counters.indices_used, size);
    return place + size <= (pool == 0u ? parameters.most_vertices : parameters.most_indices) ? place : kNoPlace;
}

void main() {
    uint slot = gl_WorkGroupID.x;
    uint tile = jobs[slot].tile;
    uint vertices = jobs[slot].cell_vertices + jobs[slot].extras;
    uint indices = 6u * jobs[slot].quads + 3u * jobs[slot].extras;
    bool waits = jobs[slot].waits != 0u;
    if (!waits) {
        ranges[tile].index_count = 0u;
        uint vertex_class = class_for(vertices);
        uint index_class = class_for(indices);
        if (vertex_class != kNoClass && ranges[tile].vertex_class == kNoClass) {
            uint place = take(0u, vertex_class);
            waits = place == kNoPlace;
            if (!waits) {
                ranges[tile].first_vertex = int(place);
                ranges[tile].vertex_class = vertex_class;
            }
        }
        if (!waits && index_class != kNoClass && ranges[tile].index_class == kNoClass) {
            uint place = take(1u, index_class);
            waits = place == kNoPlace;
            if (!waits) {
                ranges[tile].first_index = place;
                ranges[tile].index_class = index_class;
            }
        }
    }
    if (waits) {
        jobs[slot].waits = 1u;
        waiting[atomicAdd(counters.waiting, 1u)] = tile;
        ranges[tile].marked = 1u;
    } else {
        ranges[tile].index_count = indices;
        ranges[tile].instance_count = 1u;
        ranges[tile].vertices = vertices;
        ranges[tile].disagreeing = jobs[slot].disagreeing;
        ranges[tile].marked = 0u;
        atomicAdd(counters.triangles, indices / 3u);
    }
}
