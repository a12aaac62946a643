// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Cuts, fills or paints rays with capsules: one invocation owns one ray and applies all its capsules in order. The
// effect of one capsule on one ray is defined in shaders/shared/capsule.h and span_edit.h, the same text that the CPU
// engine compiles.
#include "shaders/shared/cut_job.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { CutParameters parameters; };
layout(std430, binding = 2) readonly buffer Capsules { ivec2 capsule_words[]; };  // five pairs a Capsule
layout(std430, binding = 3) readonly buffer Tasks { CutTask tasks[]; };
layout(std430, binding = 4) readonly buffer Order { uint order[]; };
layout(std430, binding = 5) buffer Counters { CutCounters counters; };
layout(std430, binding = 8) readonly buffer Continued { PendingRay continued[]; };

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

uint next_near(PendingRay job, uint stop, int axis, int ray_u, int ray_v) {
    uint next = job.next;
    while (next < stop && !near(capsule_at(order[next]), axis, ray_u, ray_v)) ++next;
    return next;
}

PendingRay take_job() {
    PendingRay job;
    job.ray = kNoRay;
    if (parameters.pending > 0u) {
        if (gl_GlobalInvocationID.x < parameters.pending) job = continued[gl_GlobalInvocationID.x];
        return job;
    }
    // The last task that begins no later than this group.
    uint at = parameters.first_task;
    for (uint beyond = parameters.end_task; beyond - at > 1u;) {
        uint middle = (at + beyond) / 2u;
        if (tasks[middle].first_group <= gl_WorkGroupID.x)
            at = middle;
        else
            beyond = middle;
    }
    CutTask task = tasks[at];
    int number = int((gl_WorkGroupID.x - task.first_group) * 64u + gl_LocalInvocationID.x);
    if (number < task.width * task.height)
        job.ray = ray_code(task.axis, task.u + number % task.width, task.v + number / task.width);
    job.next = task.first;
    job.end = task.end;
    job.changed_lo = kMaxDepth;
    job.changed_hi = -1;
    job.touched = 0u;
    return job;
}
uint end_of(PendingRay job) { return job.end; }

RaySpan present_span;
uint present_work;
CapsuleRay from_ray;
void look_at(PendingRay job, int axis, int ray_u, int ray_v) {
    Capsule capsule = capsule_at(order[job.next]);
    from_ray = capsule_from_ray(capsule, axis, ray_u, ray_v);
    present_span = capsule_span(from_ray);
    present_work = capsule.work;
}
DexelEnd end_of_span(int axis, int depth, bool upper, int cells) {
    return capsule_end(from_ray, axis, depth, present_work, cells);
}
bool touches(bool there) { return there; }
#include "shaders/cut_ray.glsl"
