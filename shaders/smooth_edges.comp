// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Lists the ends that are to be moved or made, and the rays that they are on: one invocation a ray of the ball. The
// ends of a ray lie together and in order; the order of the rays is any.
#include "shaders/smooth_buffers.glsl"

uint code;
bool is_listing = false;  // else they are counted
bool is_changing;
uint end_count;
uint first_end;

void keep_ends(uint from, uint to) {}
void add_end(SmoothEdge edge, uint number, uint flags) {
    if (is_listing)
        smooth_ends[first_end + end_count] = SmoothEnd(code, edge.low, number, flags, DexelEnd(0u, 0u), 0u, 0u);
    ++end_count;
}
void move_ends(SmoothEdge edge, uint from, uint to, bool low_inside) {
    is_changing = true;
    for (uint i = from; i < to; ++i) {
        uint flags = low_inside ? kLowInside : 0u;
        if (low_inside == (((i - from) & 1u) != 0u)) flags |= kInsideBetween;
        if (i + 1u < to) flags |= kHasNext;
        add_end(edge, i, flags);
    }
}
void make_end_on(SmoothEdge edge, bool low_inside) {
    is_changing = true;
    add_end(edge, 0u, low_inside ? kIsMade | kLowInside : kIsMade);
}
void drop_ends() { is_changing = true; }
#include "shaders/smooth_walk.glsl"

void main() {
    if (is_stopped()) return;
    SmoothTask task = tasks[parameters.ball];
    code = ray_with_nodes(task, gl_GlobalInvocationID.x);
    if (code == kNoRay) return;
    RayRef ray = rays[index_of_ray(axis_of(code), u_of(code), v_of(code))];
    uint count = count_of(ray);
    if (count > kMostSmoothEnds) {
        stop(kBeyondDevice);
        return;
    }
    for (int turn = 0; turn < 2; ++turn) {
        is_listing = turn == 1;
        is_changing = false;
        end_count = 0u;
        walk_ray(task, code, ray);
        if (!is_changing) return;
        if (turn == 0) {
            uint most = count + end_count;
            first_end = atomicAdd(smooth_counts.ends, end_count);
            uint place = atomicAdd(smooth_counts.rays, 1u);
            uint first_fresh = atomicAdd(smooth_counts.fresh, most);
            if (first_end + end_count > parameters.ends || place >= parameters.rays ||
                first_fresh + most > parameters.fresh) {
                stop(kShortOfSpace);
                return;
            }
            smooth_rays[place] = SmoothRay(code, first_end, first_fresh, 0u, kMaxDepth, -1, 0u);
            atomicMax(smooth_counts.of_ends.x, groups_for(first_end + end_count));
            atomicMax(smooth_counts.of_rays.x, groups_for(place + 1u));
        }
    }
}
