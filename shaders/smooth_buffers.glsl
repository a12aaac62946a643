// SPDX-License-Identifier: MIT
// The buffers of the shaders that smooth (compute/vulkan/smooth_passes.hpp), the same for all of them. Include first.
#include "shaders/shared/smooth_job.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { SmoothParameters parameters; };
layout(std430, binding = 0) buffer Rays { RayRef rays[]; };
layout(std430, binding = 1) buffer Counters { CutCounters counters; };
layout(std430, binding = 2) readonly buffer Tasks { SmoothTask tasks[]; };
layout(std430, binding = 3) buffer Smooth { SmoothCounters smooth_counts; };
layout(std430, binding = 4) buffer Points { SmoothPoint points[]; };  // of the present level, as they came
layout(std430, binding = 5) buffer Sorted { SmoothPoint sorted[]; };  // of all levels, by boxes
layout(std430, binding = 6) buffer Boxes { uint boxes[]; };
layout(std430, binding = 7) buffer Order { uint order[]; };
layout(std430, binding = 8) buffer Nodes { SmoothNode nodes[]; };
layout(std430, binding = 9) buffer Waves { uint waves[]; };  // nodes of all waves
layout(std430, binding = 10) buffer SmoothEnds { SmoothEnd smooth_ends[]; };
layout(std430, binding = 11) buffer SmoothRays { SmoothRay smooth_rays[]; };
layout(std430, binding = 12) buffer Fresh { DexelEnd fresh[]; };
layout(std430, binding = 13) writeonly buffer Changed { ChangedRay changed[]; };
layout(std430, binding = 14) writeonly buffer Exported { DexelEnd exported[]; };
#include "shaders/dexel_store.glsl"

// Has the kernels that follow do nothing. This one may go on, and so counts what it lacks.
void stop(uint why) { atomicOr(smooth_counts.why, why); }
bool is_stopped() { return smooth_counts.stopped != 0u || smooth_counts.why != 0u; }

uint index_of_ray(int axis, int u, int v) {
    return parameters.first_ray[axis] + uint(v * parameters.rays_u[axis] + u);
}

// The rays of all axes between two nodes, axis by axis and row by row. Returns kNoRay beyond the last.
uint ray_between(int lo_x, int lo_y, int lo_z, int hi_x, int hi_y, int hi_z, uint number) {
    int lo[3] = int[3](lo_x, lo_y, lo_z);
    int size[3] = int[3](hi_x - lo_x + 1, hi_y - lo_y + 1, hi_z - lo_z + 1);
    for (int axis = 0; axis < 3; ++axis) {
        int u = (axis + 1) % 3;
        int v = (axis + 2) % 3;
        uint count = uint(size[u] * size[v]);
        if (number < count) return ray_code(axis, lo[u] + int(number) % size[u], lo[v] + int(number) / size[u]);
        number -= count;
    }
    return kNoRay;
}
uint ray_with_nodes(SmoothTask task, uint number) {
    return ray_between(task.lo[0], task.lo[1], task.lo[2], task.hi[0], task.hi[1], task.hi[2], number);
}

// The nodes of the ball and one more on each side lie in rows along x.
uint index_of_node(SmoothTask task, int x, int y, int z) {
    int width = task.hi[0] - task.lo[0] + 3;
    int height = task.hi[1] - task.lo[1] + 3;
    return uint(((z - task.lo[2] + 1) * height + y - task.lo[1] + 1) * width + x - task.lo[0] + 1);
}
ivec3 place_of_node(SmoothTask task, uint index) {
    int width = task.hi[0] - task.lo[0] + 3;
    int height = task.hi[1] - task.lo[1] + 3;
    int row = int(index) / width;
    return ivec3(int(index) % width, row % height, row / height) +
           ivec3(task.lo[0] - 1, task.lo[1] - 1, task.lo[2] - 1);
}
ivec3 node_on_ray(int axis, int u, int v, int s) {
    return axis == 0 ? ivec3(s, u, v) : (axis == 1 ? ivec3(v, s, u) : ivec3(u, v, s));
}

uint behind_counts() { return parameters.boxes + parameters.rows; }
// Returns where the points of a level begin among the sorted ones.
uint first_of_level(int level) {
    uint first = 0u;
    for (int i = 0; i < level; ++i) first += smooth_counts.points[i];
    return first;
}

uint groups_for(uint count) { return (count + 63u) / 64u; }

SmoothPoint point_of(dvec3 place, dvec3 normal, double area, double offset, uint key, uint material) {
    SmoothPoint point;
    point.place_area = dvec4(place, area);
    point.normal_offset = dvec4(normal, offset);
    point.key_box = uvec4(key, 0u, 0u, material);
    point.unused = uvec4(0u);
    return point;
}
