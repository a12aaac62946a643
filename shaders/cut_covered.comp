// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Cuts, fills or paints rays with what a tool covers of them, as cover_rays.comp has found it: one invocation owns one
// ray and applies all its spans in order. The same rules as those of the host (compute/rays/set_algebra.hpp,
// compute/tools/apply.cpp), in the text of shaders/shared/span_edit.h.
#include "shaders/shared/cover_job.h"
#include "shaders/shared/cut_job.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { CutParameters parameters; };
layout(std430, binding = 2) readonly buffer Spans { CoveredSpan spans[]; };
layout(std430, binding = 3) readonly buffer Covered { CoveredRay covered[]; };
layout(std430, binding = 4) readonly buffer Cover { CoverCounters cover; };
layout(std430, binding = 5) buffer Counters { CutCounters counters; };
layout(std430, binding = 8) readonly buffer Continued { PendingRay continued[]; };

// Each ray with its spans is a job; where some of them are not known, none is, and the pass does not begin.
PendingRay take_job() {
    PendingRay job;
    job.ray = kNoRay;
    if (!is_complete(cover)) {
        counters.left[parameters.pass + 1u] = kNotBegun;
        counters.uncovered[parameters.pass] = 1u;
        return job;
    }
    uint number = gl_GlobalInvocationID.x;
    if (parameters.pending > 0u) {
        if (number < parameters.pending) job = continued[number];
        return job;
    }
    if (number < parameters.visited && covered[number].count > 0u) job.ray = covered[number].ray;
    job.next = 0u;
    job.end = number;
    job.changed_lo = kMaxDepth;
    job.changed_hi = -1;
    job.touched = 0u;
    return job;
}
uint end_of(PendingRay job) { return covered[job.end].count; }
uint next_near(PendingRay job, uint stop, int axis, int ray_u, int ray_v) { return job.next; }

RaySpan present_span;
uint present_work;
CoveredSpan present;
void look_at(PendingRay job, int axis, int ray_u, int ray_v) {
    present = spans[covered[job.end].first + job.next];
    present_span.lo = present.lo;
    present_span.hi = present.hi;
    present_work = parameters.work;
}

// Where filling stops at the lattice's border, before the tool does, the normal lies along the ray.
DexelEnd end_of_span(int axis, int depth, bool upper, int cells) {
    uint normal = upper ? present.normal_hi : present.normal_lo;
    if (int(present_work >> 8) != kFill)
        normal = opposite_normal(normal);
    else if (depth != (upper ? present.hi : present.lo))
        normal = axis_normal(axis, upper);
    return make_end(depth, present_work & 0xffu, normal);
}

// Rays count that the tool covers, whether they hold material or not.
bool touches(bool there) { return true; }
#include "shaders/cut_ray.glsl"
