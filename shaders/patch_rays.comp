// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Gives rays the ends that the host has worked out for them: one invocation a ray. A ray that finds no room is left alone and
// counted; the host then makes space and runs the whole patch again, which does no harm to those that were written.
#include "shaders/shared/cut_job.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { CutParameters parameters; };
layout(std430, binding = 0) buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) readonly buffer Patch { PatchRay patches[]; };
layout(std430, binding = 2) readonly buffer PatchEnds { DexelEnd patch_ends[]; };
layout(std430, binding = 3) buffer Counters { CutCounters counters; };
#include "shaders/dexel_store.glsl"
#include "shaders/dexel_rooms.glsl"

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= parameters.pending) return;
    PatchRay patched = patches[number];
    int axis = axis_of(patched.ray);
    uint index = parameters.first_ray[axis] + uint(v_of(patched.ray) * parameters.rays_u[axis] + u_of(patched.ray));
    RayRef ray = rays[index];
    if (patched.count > room_of(ray)) {  // a ray without a place of its own says that it has room for one
        ray.count_room = 0u;  // what it holds need not be moved
        ray = with_larger_room(ray, patched.count);
        if (patched.count > room_of(ray)) return;
    }
    for (uint i = 0u; i < patched.count; ++i) store.at[ray.first + i] = patch_ends[patched.first + i];
    ray.count_room = (ray.count_room & 0xff000000u) | patched.count;
    rays[index] = ray;
    atomicMax(counters.longest, patched.count);
}
