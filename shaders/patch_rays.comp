// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Replaces the ends of rays by those that the host has computed: one invocation per ray. A ray that finds no room is
// left unchanged and counted; the host then provides space and runs the whole patch again, which is harmless for the
// rays already written.
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
    // A ray without a range of its own states room for 1 end, too little for any interval.
    if (patched.count > room_of(ray)) {
        ray.count_room = 0u;  // its present ends need not be moved
        ray = with_larger_room(ray, patched.count);
        if (patched.count > room_of(ray)) {
            atomicAdd(counters.left[0], 1u);
            return;
        }
    }
    for (uint i = 0u; i < patched.count; ++i) store.at[ray.first + i] = patch_ends[patched.first + i];
    ray.count_room = (ray.count_room & 0xff000000u) | patched.count;
    rays[index] = ray;
    atomicMax(counters.longest, patched.count);
}
