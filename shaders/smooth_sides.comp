// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Moves the nodes of a wave to the other side of the surface where the field says so, and lists the neighbours of those
// that have moved, the next wave: one invocation a node. Which nodes those are does not depend on any order.
#include "shaders/smooth_buffers.glsl"
#include "shaders/smooth_near.glsl"

// Returns the signed distance of a node from the surface as it was: from the nearest plane of an end on its edges, or a
// cell where there is none.
double distance_before(ivec3 node, bool is_inside) {
    double distance = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        int at = node[axis];
        RayRef ray = rays[index_of_ray(axis, node[(axis + 1) % 3], node[(axis + 2) % 3])];
        uint count = count_of(ray);
        if (count > kMostSmoothEnds) {
            stop(kBeyondDevice);
            count = 0u;
        }
        uint i = 0u;
        for (; i < count; ++i) {
            DexelEnd end = store.at[ray.first + i];
            int depth = depth_of(end);
            if (depth > (at - 1) * kUnitsPerCell && depth <= (at + 1) * kUnitsPerCell)
                distance = min(distance, distance_of_end(end, axis, at));
        }
        if (i < count) stop(kBeyondDevice);  // a software driver has ended the loop
    }
    return is_inside ? -distance : distance;
}

// Adds a neighbour of a node that has moved to the next wave, once.
void spread(uint index, uint flags, uint first) {
    uint other = nodes[index].flags;
    if ((other & kWeighs) == 0u || (other & kIsKnown) != 0u || ((other ^ flags) & kWasInside) != 0u) return;
    if ((atomicOr(nodes[index].flags, kIsKnown) & kIsKnown) != 0u) return;
    uint wave = parameters.step + 1u;
    uint place = atomicAdd(smooth_counts.waves[wave], 1u);
    if (first + place >= parameters.waves) {
        stop(kShortOfSpace);
        return;
    }
    waves[first + place] = index;
    atomicMax(smooth_counts.of_waves[wave].x, groups_for(place + 1u));
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (is_stopped() || number >= smooth_counts.waves[parameters.step]) return;
    uint first = 0u;
    for (uint i = 0u; i < parameters.step; ++i) first += smooth_counts.waves[i];
    SmoothTask task = tasks[parameters.ball];
    uint index = waves[first + number];
    ivec3 node = place_of_node(task, index);
    uint flags = nodes[index].flags;
    bool was_inside = (flags & kWasInside) != 0u;
    dvec3 place = dvec3(node);
    Smoothing smoothing = smoothing_at(path_of(task), place);
    FieldValue value = field_at(task, place, smoothing.width);
    double field = distance_before(node, was_inside);
    bool is_inside = was_inside;
    if (value.known) {
        field = part_of_way(field, smoothing.share, value.distance);
        is_inside = field < 0.0;
    }
    nodes[index].field = field;
    if (is_inside == was_inside) return;
    if (is_inside)
        atomicOr(nodes[index].flags, kIsInside);
    else
        atomicAnd(nodes[index].flags, ~kIsInside);
    uint up = uint(task.hi[0] - task.lo[0] + 3);
    uint far = up * uint(task.hi[1] - task.lo[1] + 3);
    uint next = first + smooth_counts.waves[parameters.step];
    spread(index - 1u, flags, next);
    spread(index + 1u, flags, next);
    spread(index - up, flags, next);
    spread(index + up, flags, next);
    spread(index - far, flags, next);
    spread(index + far, flags, next);
}
