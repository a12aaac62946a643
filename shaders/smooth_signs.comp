// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Sets which nodes were inside, by the rays along z, and which ones the tool reaches: one invocation a ray.
#include "shaders/smooth_buffers.glsl"

void main() {
    if (is_stopped()) return;
    SmoothTask task = tasks[parameters.ball];
    int width = task.hi[0] - task.lo[0] + 3;
    int height = task.hi[1] - task.lo[1] + 3;
    int number = int(gl_GlobalInvocationID.x);
    if (number >= width * height) return;
    int x = task.lo[0] - 1 + number % width;
    int y = task.lo[1] - 1 + number / width;
    RayRef ray = rays[index_of_ray(2, x, y)];
    uint count = count_of(ray);
    if (count > kMostSmoothEnds) {
        stop(kBeyondDevice);
        return;
    }
    SmoothPath path = path_of(task);
    bool is_within = x >= task.lo[0] && x <= task.hi[0] && y >= task.lo[1] && y <= task.hi[1];
    uint below = 0u;
    for (int z = task.lo[2] - 1; z <= task.hi[2] + 1; ++z) {
        while (below < count && depth_of(store.at[ray.first + below]) <= z * kUnitsPerCell) ++below;
        uint flags = (below & 1u) != 0u ? kWasInside | kIsInside : 0u;
        dvec3 off = off_path(path, dvec3(x, y, z));
        if (is_within && z >= task.lo[2] && z <= task.hi[2] && dot3(off, off) < path.radius * path.radius)
            flags |= kWeighs;
        nodes[index_of_node(task, x, y, z)] = SmoothNode(0.0, flags, 0u);
    }
}
