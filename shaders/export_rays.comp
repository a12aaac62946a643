// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Exports the current ends of rays on the list of stale rays for the host to read: one invocation per ray. If the space
// is too small for all ends, the counter states how much is needed, and the host runs the shader again.
#include "shaders/shared/cut_job.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { CutParameters parameters; };
layout(std430, binding = 0) buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) readonly buffer Stale { uint stale[]; };
layout(std430, binding = 2) buffer Counters { CutCounters counters; };
layout(std430, binding = 3) writeonly buffer Changed { ChangedRay changed[]; };
layout(std430, binding = 4) writeonly buffer Exported { DexelEnd exported[]; };
#include "shaders/dexel_store.glsl"

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= parameters.pending) return;
    uint code = stale[parameters.first_stale + number];
    int axis = axis_of(code);
    uint index = parameters.first_ray[axis] + uint(v_of(code) * parameters.rays_u[axis] + u_of(code));
    RayRef ray = rays[index];
    rays[index].count_room = ray.count_room & ~kStale;
    uint count = count_of(ray);
    uint first = atomicAdd(counters.exported, count);
    changed[number] = ChangedRay(code, first, count, 0, 0);
    if (first + count <= parameters.export_size) {
        for (uint i = 0u; i < count; ++i) exported[first + i] = store.at[ray.first + i];
    }
}
