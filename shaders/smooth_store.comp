// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Stores and exports the new ends of the rays that change: one invocation a ray. Where anything is missing nothing is
// stored, the pass has not begun, and those behind it do not begin either.
#include "shaders/smooth_buffers.glsl"

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (is_stopped() || smooth_counts.unstored != 0u) {
        if (number == 0u) counters.left[parameters.pass + 1u] = kNotBegun;
        return;
    }
    if (number >= smooth_counts.rays) return;
    SmoothRay of = smooth_rays[number];
    if (of.changed_lo > of.changed_hi) return;
    uint index = index_of_ray(axis_of(of.ray), u_of(of.ray), v_of(of.ray));
    RayRef ray = rays[index];
    for (uint i = 0u; i < of.count; ++i) {
        DexelEnd end = fresh[of.first_fresh + i];
        store.at[ray.first + i] = end;
        exported[of.exported + i] = end;
    }
    rays[index].count_room = (ray.count_room & 0xff000000u) | of.count;
    atomicAdd(counters.touched, 1u);
    atomicMax(counters.longest, of.count);
    changed[atomicAdd(counters.changed, 1u)] =
        ChangedRay(of.ray, of.exported, of.count, of.changed_lo, of.changed_hi);
}
