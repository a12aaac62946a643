// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Puts together the new ends of the rays that change, and finds room for them in the store and among the exported ends:
// one invocation a ray. What the solid holds stays as it is.
#include "shaders/smooth_buffers.glsl"
#include "shaders/dexel_rooms.glsl"

RayRef ray;
uint first_fresh;
uint fresh_count = 0u;
uint next_end;

void add_fresh(DexelEnd end) {
    fresh[first_fresh + fresh_count] = end;
    ++fresh_count;
}
void keep_ends(uint from, uint to) {
    for (uint i = from; i < to; ++i) add_fresh(store.at[ray.first + i]);
}
// Two ends that meet, or between which the field sees nothing, are dropped.
void move_ends(SmoothEdge edge, uint from, uint to, bool low_inside) {
    uint first = fresh_count;
    for (uint i = from; i < to; ++i) {
        SmoothEnd end = smooth_ends[next_end + i - from];
        if (end.is_gone != 0u)
            ++i;
        else if (fresh_count > first && depth_of(fresh[first_fresh + fresh_count - 1u]) >= depth_of(end.result))
            --fresh_count;
        else
            add_fresh(end.result);
    }
    next_end += to - from;
}
void make_end_on(SmoothEdge edge, bool low_inside) {
    add_fresh(smooth_ends[next_end].result);
    ++next_end;
}
void drop_ends() {}
#include "shaders/smooth_walk.glsl"

bool is_same(uint held, uint now) {
    DexelEnd a = store.at[ray.first + held];
    DexelEnd b = fresh[first_fresh + now];
    return a.depth_material == b.depth_material && a.normal == b.normal;
}

// Returns the range of depths in which the ray changes (assign_ray in compute/rays/ray_batch.cpp); none when lo > hi.
RaySpan changed_depths(uint count) {
    RaySpan depths;
    depths.lo = kMaxDepth;
    depths.hi = -1;
    uint shorter = min(count, fresh_count);
    uint front = 0u;
    uint back = 0u;
    while (front < shorter && is_same(front, front)) ++front;
    if (front == count && front == fresh_count) return depths;
    while (front + back < shorter && is_same(count - 1u - back, fresh_count - 1u - back)) ++back;
    depths.hi = 0;
    if (front + back < count) {
        depths.lo = min(depths.lo, depth_of(store.at[ray.first + front]));
        depths.hi = max(depths.hi, depth_of(store.at[ray.first + count - 1u - back]));
    }
    if (front + back < fresh_count) {
        depths.lo = min(depths.lo, depth_of(fresh[first_fresh + front]));
        depths.hi = max(depths.hi, depth_of(fresh[first_fresh + fresh_count - 1u - back]));
    }
    return depths;
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (is_stopped() || number >= smooth_counts.rays) return;
    SmoothRay of = smooth_rays[number];
    uint index = index_of_ray(axis_of(of.ray), u_of(of.ray), v_of(of.ray));
    ray = rays[index];
    first_fresh = of.first_fresh;
    next_end = of.first_end;
    walk_ray(tasks[parameters.ball], of.ray, ray);
    RaySpan depths = changed_depths(count_of(ray));
    of.count = fresh_count;
    of.changed_lo = depths.lo;
    of.changed_hi = depths.hi;
    if (depths.lo <= depths.hi) {
        if (fresh_count > parameters.most_ends) stop(kBeyondDevice);
        // A ray without a range of its own states room for 1 end, too little for any interval.
        if (fresh_count > room_of(ray)) {
            ray = with_larger_room(ray, fresh_count);
            rays[index] = ray;
        }
        of.exported = atomicAdd(counters.exported, fresh_count);
        if (fresh_count > room_of(ray) || of.exported + fresh_count > parameters.export_size)
            atomicAdd(smooth_counts.unstored, 1u);
    }
    smooth_rays[number] = of;
}
