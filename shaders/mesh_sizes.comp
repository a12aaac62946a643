// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Numbers the vertices of each tile, cell after cell, takes a new range of each pool for them, and writes the tile's
// draw command. One work group per tile. A tile that finds no range, or had no space in an earlier stage, is added to
// the list of waiting tiles and keeps its old ranges and its old draw command, until the host has enlarged the list or
// the pool that was too small.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_ranges.glsl"

layout(local_size_x = 64) in;

shared uint sums[kMeshGroup];
shared uint twice;

void take_ranges(uint slot, uint cell_vertices) {
    uint tile = jobs[slot].tile;
    uint vertices = cell_vertices + jobs[slot].extras;
    uint indices = 6u * jobs[slot].quads + 3u * jobs[slot].extras;
    uint vertex_class = class_for(vertices);
    uint index_class = class_for(indices);
    uint vertex_place = 0u;
    uint index_place = 0u;
    bool waits = jobs[slot].waits != 0u;
    if (waits) vertex_class = kNoClass;
    if (vertex_class != kNoClass) {
        vertex_place = take(0u, vertex_class);
        waits = vertex_place == kNoPlace;
        if (waits) vertex_class = kNoClass;
    }
    if (waits) index_class = kNoClass;
    if (index_class != kNoClass) {
        index_place = take(1u, index_class);
        waits = index_place == kNoPlace;
        if (waits) index_class = kNoClass;
    }
    TileRange range = ranges[tile];
    jobs[slot].old_vertex = waits ? vertex_place : uint(range.first_vertex);
    jobs[slot].old_vertex_class = waits ? vertex_class : range.vertex_class;
    jobs[slot].old_index = waits ? index_place : range.first_index;
    jobs[slot].old_index_class = waits ? index_class : range.index_class;
    if (waits) {
        jobs[slot].waits = 1u;
        waiting[atomicAdd(counters.waiting, 1u)] = tile;
        ranges[tile].marked = 1u;
        return;
    }
    range.index_count = indices;
    range.instance_count = 1u;
    range.first_index = index_place;
    range.first_vertex = int(vertex_place);
    range.vertices = vertices;
    range.vertex_class = vertex_class;
    range.index_class = index_class;
    range.disagreeing = jobs[slot].disagreeing;
    range.marked = 0u;
    range.cells = jobs[slot].cells;
    range.twice = twice;
    ranges[tile] = range;
    atomicAdd(counters.triangles, indices / 3u);
    atomicAdd(counters.meshed_cells, jobs[slot].made);
}

void main() {
    uint slot = gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationID.x;
    uint count = jobs[slot].cells;
    uint share = (count + 63u) / 64u;
    uint from = min(lane * share, count) + jobs[slot].first_cell;
    uint to = min((lane + 1u) * share, count) + jobs[slot].first_cell;
    if (lane == 0u) twice = 0u;
    barrier();
    uint sum = 0u;
    uint faces = 0u;
    for (uint i = from; i < to; ++i) {
        uint of_cell = cells[i].made.w;
        sum += vertices_in(of_cell);
        faces |= of_cell >> 16;
    }
    sums[lane] = sum;
    if (faces != 0u) twice = 1u;
    barrier();
    if (lane == 0u) {
        uint all = 0u;
        for (int i = 0; i < kMeshGroup; ++i) {
            uint of_lane = sums[i];
            sums[i] = all;
            all += of_lane;
        }
        jobs[slot].cell_vertices = all;
        take_ranges(slot, all);
    }
    barrier();
    uint at = sums[lane];
    for (uint i = from; i < to; ++i) {
        cells[i].made.z = at;
        at += vertices_in(cells[i].made.w);
    }
}
