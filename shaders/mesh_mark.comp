// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Marks the tiles that the rays changed by a cut can have altered (cells_changed in shaders/shared/mesh_tile.h): one
// invocation per ray, as many as the cut may have changed. A tile that gets no slot waits for another submission.
#include "shaders/shared/cut_job.h"
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 10) readonly buffer CutCount { CutCounters cut; };
layout(std430, binding = 11) readonly buffer Changed { ChangedRay changed[]; };

void mark(uint tile) {
    if (atomicExchange(ranges[tile].marked, 1u) != 0u) return;
    uint slot = atomicAdd(counters.tiles, 1u);
    if (slot < parameters.slots) {
        dirty[slot] = tile;
        atomicAdd(counters.tile_groups[0], 1u);
    } else {
        waiting[atomicAdd(counters.waiting, 1u)] = tile;
    }
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= cut.changed) return;
    ChangedRay ray = changed[number];
    CellRange cells = cells_changed(axis_of(ray.ray), u_of(ray.ray), v_of(ray.ray), ray.changed_lo, ray.changed_hi);
    ivec3 lo = ivec3(cells.lo[0], cells.lo[1], cells.lo[2]);
    ivec3 hi = ivec3(cells.hi[0], cells.hi[1], cells.hi[2]);
    ivec3 last = ivec3(parameters.nodes[0], parameters.nodes[1], parameters.nodes[2]) - 1;
    ivec3 from = clamp(lo, ivec3(0), last) / kMeshTile;
    ivec3 to = clamp(hi + 1, ivec3(0), last) / kMeshTile;  // the tile above sees the cell too
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            for (int x = from.x; x <= to.x; ++x) {
                mark(uint((z * parameters.tiles[1] + y) * parameters.tiles[0] + x));
            }
        }
    }
}
