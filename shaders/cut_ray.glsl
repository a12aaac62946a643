// SPDX-License-Identifier: MIT
// How one invocation applies all spans of its work to its ray, in order; the main program of cut_rays.comp and
// cut_covered.comp. Include after declaring `parameters`, the buffers of a ray's work, `continued` and `counters`, and
//   PendingRay take_job();                    the ray that this invocation works on; kNoRay where there is none
//   uint end_of(PendingRay job);              one beyond the last span of the job
//   uint next_near(PendingRay job, uint stop, int axis, int ray_u, int ray_v);
//                                             the first from job.next on that may cover the ray, or stop
//   void look_at(PendingRay job, int axis, int ray_u, int ray_v);   makes job.next the present span
//   RaySpan present_span;  uint present_work; its depths, and what is done there (capsule.h)
//   DexelEnd end_of_span(int axis, int depth, bool upper, int cells);   the end that it leaves at a depth
//   bool touches(bool there);                 whether a ray that it covers counts, where it holds material or not
//
// A ray that cannot continue is left as it was before the current span and added to the pending list; the host
// provides the space and dispatches the list again. Nothing is ever dropped.
//
// A pass is bounded: in it a ray takes at most parameters.cuts spans and tests at most parameters.looks. Drivers stop
// work that runs for seconds, and a software driver ends an invocation's loops, silently, after 65535 iterations of all
// of them.
layout(std430, binding = 0) buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) writeonly buffer Pending { PendingRay pending[]; };
#include "shaders/dexel_store.glsl"
layout(std430, binding = 6) writeonly buffer Changed { ChangedRay changed[]; };
layout(std430, binding = 7) writeonly buffer Exported { DexelEnd exported[]; };
#include "shaders/dexel_rooms.glsl"

uint first_end = 0u;  // index of the current ray's first end
DexelEnd load_end(uint i) { return store.at[first_end + i]; }
#include "shaders/shared/span_edit.h"

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

void cut_ray() {
    PendingRay job = take_job();
    if (job.ray == kNoRay) return;
    int axis = axis_of(job.ray);
    int ray_u = u_of(job.ray) * kUnitsPerCell;
    int ray_v = v_of(job.ray) * kUnitsPerCell;
    uint index = parameters.first_ray[axis] + uint(v_of(job.ray) * parameters.rays_u[axis] + u_of(job.ray));
    int rays_u = parameters.rays_u[axis];
    int rays_v = parameters.rays_v[axis];
    RayRef ray = rays[index];
    uint end = end_of(job);
    uint stop = min(end, job.next + parameters.looks);
    uint touched = job.touched;
    uint cuts = 0u;
    bool waits = false;
    job.next = next_near(job, stop, axis, ray_u, ray_v);
    if (job.next < stop) {
        // The condition stands at the end: otherwise a driver that runs both sides of a branch under a mask would
        // execute the long body once more for nothing.
        do {
            look_at(job, axis, ray_u, ray_v);
            RaySpan span = present_span;
            uint count = count_of(ray);
            first_end = ray.first;
            int operation = int(present_work >> 8);
            // A cut skips rays without material, and filling skips the lattice's border.
            bool there =
                operation == kFill ? may_fill_ray(u_of(job.ray), v_of(job.ray), rays_u, rays_v) : count > 0u;
            if (touches(there) && span.lo <= span.hi) touched = 1u;
            if (operation == kPaint) {
                if (span.lo <= span.hi) {
                    RaySpan painted = paint_ends(count, span, present_work & 0xffu);
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
                        if (edit.insert_lo != 0u) end_lo = end_of_span(axis, span.lo, false, cells);
                        if (edit.insert_hi != 0u) end_hi = end_of_span(axis, span.hi, true, cells);
                        apply_edit(count, edit, end_lo, end_hi);
                        ray.count_room = (ray.count_room & 0xff000000u) | new_count;
                        job.changed_lo = min(job.changed_lo, edit.changed_lo);
                        job.changed_hi = max(job.changed_hi, edit.changed_hi);
                    }
                }
            }
            ++cuts;
            if (!waits) {
                ++job.next;
                job.next = next_near(job, stop, axis, ray_u, ray_v);
            }
        } while (job.next < stop && cuts < parameters.cuts && !waits);
    }
    if (touched > job.touched) atomicAdd(counters.touched, 1u);
    job.touched = touched;
    waits = waits || job.next < end;
    if (job.changed_lo <= job.changed_hi) {
        uint count = count_of(ray);
        atomicMax(counters.longest, count);
        rays[index] = ray;
        if (!waits) {
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
        atomicAdd(counters.left[parameters.pass + 1u], 1u);
        atomicMax(counters.longest, count_of(ray));
    }
}

// Keeps this pass, and so those after it, from beginning where something before it is undone.
void main() {
    if (counters.left[parameters.pass] != 0u) {
        counters.left[parameters.pass + 1u] = kNotBegun;
        return;
    }
    cut_ray();
}
