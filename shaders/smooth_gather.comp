// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Gathers the ends near the path of a ball as points of the surface: one invocation a ray. The key of a point is its
// ray's number, in the order in which the host goes through the rays.
#include "shaders/smooth_buffers.glsl"
#include "shaders/smooth_boxes.glsl"

void main() {
    if (smooth_counts.stopped != 0u) return;
    uint number = gl_GlobalInvocationID.x;
    SmoothTask task = tasks[parameters.ball];
    uint code = ray_between(task.ray_lo[0], task.ray_lo[1], task.ray_lo[2], task.ray_hi[0], task.ray_hi[1],
                            task.ray_hi[2], number);
    if (code == kNoRay) return;
    int axis = axis_of(code);
    RayRef ray = rays[index_of_ray(axis, u_of(code), v_of(code))];
    uint count = count_of(ray);
    if (count > kMostSmoothEnds) {
        stop(kBeyondDevice);
        return;
    }
    SmoothPath path = path_of(task);
    uint first = 0u;
    uint near = 0u;
    for (int turn = 0; turn < 2; ++turn) {
        for (uint i = 0u; i < count; ++i) {
            DexelEnd end = store.at[ray.first + i];
            dvec3 place = place_on_ray(axis, u_of(code), v_of(code), depth_of(end));
            dvec3 off = off_path(path, place);
            if (dot3(off, off) <= task.reach * task.reach) {
                if (turn == 1) {
                    dvec3 normal = decoded_normal(end.normal);
                    double area = area_of_end(normal, axis);
                    put_into_box(point_of(place, normal, area, 0.0, number, material_of(end)), task, 0, first + near);
                }
                ++near;
            }
        }
        if (near == 0u) return;
        if (turn == 0) {
            first = atomicAdd(smooth_counts.points[0], near);
            if (first + near > parameters.points) {
                stop(kShortOfSpace);
                return;
            }
            atomicMax(smooth_counts.of_points[0].x, groups_for(first + near));
            near = 0u;
        }
    }
}
