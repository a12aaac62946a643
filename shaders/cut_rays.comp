// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Cuts, fills or paints rays with capsules: one invocation owns one ray and applies all its capsules in order. The
// effect of one capsule on one ray is defined in shaders/shared/capsule.h and span_edit.h, the same text that the CPU
// engine compiles.
//
// A ray that cannot continue is left as it was before the current capsule and added to the pending list; the host
// provides the space and dispatches the list again. Nothing is ever dropped.
//
// A pass is bounded: in it a ray takes at most parameters.cuts capsules and tests at most parameters.looks. Drivers
// stop work that runs for seconds, and a software driver ends an invocation's loops, silently, after 65535 iterations
// of all of them.
#include "shaders/shared/cut_job.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { CutParameters parameters; };
layout(std430, binding = 0) buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) writeonly buffer Stale { uint stale[]; };
#include "shaders/dexel_store.glsl"
layout(std430, binding = 2) readonly buffer Capsules { ivec2 capsule_words[]; };  // five pairs a Capsule
layout(std430, binding = 3) readonly buffer Tasks { CutTask tasks[]; };
layout(std430, binding = 4) readonly buffer Order { uint order[]; };
layout(std430, binding = 5) buffer Counters { CutCounters counters; };
layout(std430, binding = 6) writeonly buffer Changed { ChangedRay changed[]; };
layout(std430, binding = 7) writeonly buffer Exported { DexelEnd exported[]; };
layout(std430, binding = 8) readonly buffer Continued { PendingRay continued[]; };
layout(std430, binding = 9) writeonly buffer Pending { PendingRay pending[]; };
#include "shaders/dexel_rooms.glsl"

uint first_end = 0u;  // index of the current ray's first end
DexelEnd load_end(uint i) { return store.at[first_end + i]; }
#include "shaders/shared/span_edit.h"

const uint kNoPlace = 0xffffffffu;

// Reads words in pairs: software drivers load component by component, so pairs are faster than single words.
Capsule capsule_at(uint number) {
    ivec2 start_xy = capsule_words[5u * number + 1u];
    ivec2 start_z_along_x = capsule_words[5u * number + 2u];
    ivec2 along_yz = capsule_words[5u * number + 3u];
    ivec2 reach_work = capsule_words[5u * number + 4u];
    Capsule c;
    c.radius2 = packInt2x32(capsule_words[5u * number]);
    c.start_x = start_xy.x;
    c.start_y = start_xy.y;
    c.start_z = start_z_along_x.x;
    c.along_x = start_z_along_x.y;
    c.along_y = along_yz.x;
    c.along_z = along_yz.y;
    c.reach = reach_work.x;
    c.work = uint(reach_work.y);
    return c;
}

// Returns false only where capsule_span would find nothing; a cheap test that skips most capsules of a long list.
bool near(Capsule c, int axis, int u, int v) {
    int start_u = pick(axis, c.start_y, c.start_z, c.start_x);
    int start_v = pick(axis, c.start_z, c.start_x, c.start_y);
    int end_u = start_u + pick(axis, c.along_y, c.along_z, c.along_x);
    int end_v = start_v + pick(axis, c.along_z, c.along_x, c.along_y);
    return u >= min(start_u, end_u) - c.reach && u <= max(start_u, end_u) + c.reach &&  //
           v >= min(start_v, end_v) - c.reach && v <= max(start_v, end_v) + c.reach;
}

// Returns the first capsule from `next` on that comes near the ray, or `stop` when none does.
uint next_near(uint next, uint stop, int axis, int ray_u, int ray_v) {
    while (next < stop && !near(capsule_at(order[next]), axis, ray_u, ray_v)) ++next;
    return next;
}

// Applies the edit to the ray's ends; the ray must have room for the result.
void apply_edit(uint count, SpanEdit edit, DexelEnd end_lo, DexelEnd end_hi) {
    uint fresh = edit.insert_lo + edit.insert_hi;
    uint removed = edit.to - edit.from;
    if (fresh > removed) {  // by two at most; moves the tail up
        for (uint i = count; i > edit.to; --i)
            store.at[first_end + i - 1u + fresh - removed] = store.at[first_end + i - 1u];
    } else if (fresh < removed) {
        for (uint i = edit.to; i < count; ++i) store.at[first_end + i + fresh - removed] = store.at[first_end + i];
    }
    if (edit.insert_lo == 1u) store.at[first_end + edit.from] = end_lo;
    if (edit.insert_hi == 1u) store.at[first_end + edit.from + edit.insert_lo] = end_hi;
}

// Sets the material of the ends within the span. Returns the range of depths in which some changed, empty when lo > hi.
RaySpan paint_ends(uint count, RaySpan span, uint material) {
    RaySpan changed;
    changed.lo = kMaxDepth;
    changed.hi = -1;
    for (uint i = 0u; i < count; ++i) {
        DexelEnd end = load_end(i);
        int depth = depth_of(end);
        if (depth < span.lo || depth > span.hi || material_of(end) == material) continue;
        store.at[first_end + i] = make_end(depth, material, end.normal);
        changed.lo = min(changed.lo, depth);
        changed.hi = depth;
    }
    return changed;
}

// Returns the ray this invocation works on; ray = kNoPlace when there is none.
PendingRay take_job() {
    PendingRay job;
    job.ray = kNoPlace;
    if (parameters.pending > 0u) {
        if (gl_GlobalInvocationID.x < parameters.pending) job = continued[gl_GlobalInvocationID.x];
        return job;
    }
    CutTask task = tasks[gl_WorkGroupID.x];
    int number = task.offset + int(gl_LocalInvocationID.x);
    if (number < task.width * task.height)
        job.ray = ray_code(task.axis, task.u + number % task.width, task.v + number / task.width);
    job.next = task.first;
    job.end = task.end;
    job.changed_lo = kMaxDepth;
    job.changed_hi = -1;
    job.touched = 0u;
    return job;
}

void main() {
    PendingRay job = take_job();
    if (job.ray == kNoPlace) return;
    int axis = axis_of(job.ray);
    int ray_u = u_of(job.ray) * kUnitsPerCell;
    int ray_v = v_of(job.ray) * kUnitsPerCell;
    uint index = parameters.first_ray[axis] + uint(v_of(job.ray) * parameters.rays_u[axis] + u_of(job.ray));
    int rays_u = parameters.rays_u[axis];
    int rays_v = parameters.rays_v[axis];
    RayRef ray = rays[index];
    uint stop = min(job.end, job.next + parameters.looks);
    uint touched = job.touched;
    uint cuts = 0u;
    bool waits = false;
    job.next = next_near(job.next, stop, axis, ray_u, ray_v);
    if (job.next < stop) {
        // The condition stands at the end: otherwise a driver that runs both sides of a branch under a mask would
        // execute the long body once more for nothing.
        do {
            Capsule capsule = capsule_at(order[job.next]);
            CapsuleRay from_ray = capsule_from_ray(capsule, axis, ray_u, ray_v);
            RaySpan span = capsule_span(from_ray);
            uint count = count_of(ray);
            first_end = ray.first;
            int operation = operation_of(capsule);
            // A cut skips rays without material, and filling skips the lattice's border.
            bool there =
                operation == kFill ? may_fill_ray(u_of(job.ray), v_of(job.ray), rays_u, rays_v) : count > 0u;
            if (there && span.lo <= span.hi) touched = 1u;
            if (operation == kPaint) {
                if (span.lo <= span.hi) {
                    RaySpan painted = paint_ends(count, span, material_of_work(capsule));
                    job.changed_lo = min(job.changed_lo, painted.lo);
                    job.changed_hi = max(job.changed_hi, painted.hi);
                }
            } else if (there) {
                int cells = parameters.rays_v[(axis + 1) % 3] - 1;  // the next axis' v runs along this axis
                if (operation == kFill && span.lo <= span.hi) span = fill_within(span, cells);
                SpanEdit edit = plan_span(count, span, operation == kFill ? 1u : 0u);
                if (changes_anything(edit)) {
                    uint new_count = count_after(count, edit);
                    // A ray without a range of its own states room for 1 end, too little for any interval.
                    if (new_count > room_of(ray)) {
                        ray = with_larger_room(ray, new_count);
                        waits = new_count > room_of(ray);
                    }
                    if (!waits) {
                        first_end = ray.first;
                        DexelEnd end_lo;
                        DexelEnd end_hi;
                        if (edit.insert_lo != 0u) end_lo = capsule_end(from_ray, axis, span.lo, capsule.work, cells);
                        if (edit.insert_hi != 0u) end_hi = capsule_end(from_ray, axis, span.hi, capsule.work, cells);
                        apply_edit(count, edit, end_lo, end_hi);
                        ray.count_room = (ray.count_room & 0xff000000u) | new_count;
                        job.changed_lo = min(job.changed_lo, edit.changed_lo);
                        job.changed_hi = max(job.changed_hi, edit.changed_hi);
                    }
                }
            }
            ++cuts;
            if (!waits) job.next = next_near(job.next + 1u, stop, axis, ray_u, ray_v);
        } while (job.next < stop && cuts < parameters.cuts && !waits);
    }
    if (touched > job.touched) atomicAdd(counters.touched, 1u);
    job.touched = touched;
    waits = waits || job.next < job.end;
    if (job.changed_lo <= job.changed_hi) {
        uint count = count_of(ray);
        atomicMax(counters.longest, count);
        if (parameters.deferred != 0u) {
            if ((ray.count_room & kStale) == 0u) stale[atomicAdd(counters.stale, 1u)] = job.ray;
            ray.count_room |= kStale;
        }
        rays[index] = ray;
        if (!waits && parameters.deferred != 0u) {
            changed[atomicAdd(counters.changed, 1u)] = ChangedRay(job.ray, 0u, count, job.changed_lo, job.changed_hi);
        } else if (!waits) {
            uint first = atomicAdd(counters.exported, count);
            if (first + count <= parameters.export_size) {
                for (uint i = 0u; i < count; ++i) exported[first + i] = store.at[ray.first + i];
                changed[atomicAdd(counters.changed, 1u)] =
                    ChangedRay(job.ray, first, count, job.changed_lo, job.changed_hi);
            } else {
                waits = true;
            }
        }
    }
    if (waits) {
        pending[atomicAdd(counters.pending, 1u)] = job;
        atomicMax(counters.longest, count_of(ray));
    }
}
