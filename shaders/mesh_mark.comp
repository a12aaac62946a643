// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Which tiles the rays that a cut has changed can have altered (compute/dirty_cells.hpp): one invocation a ray, as many as
// the cut may have changed. What does not find a slot waits for another submission.
#include "shaders/shared/cut_job.h"
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 10) readonly buffer CutCount { CutCounters cut; };
layout(std430, binding = 11) readonly buffer Changed { ChangedRay changed[]; };

int cell_at(int depth) { return ((depth + kUnitsPerCell) >> kSubcellBits) - 1; }

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
    int s = axis_of(ray.ray);
    int u = (s + 1) % 3;
    int v = (s + 2) % 3;
    ivec3 lo;
    ivec3 hi;
    lo[s] = cell_at(ray.changed_lo - kNearEdgeUnits);
    hi[s] = cell_at(ray.changed_hi + kNearEdgeUnits);
    lo[u] = u_of(ray.ray) - 1;
    hi[u] = u_of(ray.ray);
    lo[v] = v_of(ray.ray) - 1;
    hi[v] = v_of(ray.ray);
    ivec3 last = ivec3(parameters.nodes[0], parameters.nodes[1], parameters.nodes[2]) - 1;
    ivec3 from = clamp(lo, ivec3(0), last) / kMeshTile;
    ivec3 to = clamp(hi + 1, ivec3(0), last) / kMeshTile;  // also seen from above
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            for (int x = from.x; x <= to.x; ++x) {
                mark(uint((z * parameters.tiles[1] + y) * parameters.tiles[0] + x));
            }
        }
    }
}
