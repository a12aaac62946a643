// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Computes where the surface crosses each lattice edge, and with which normal and material
// (shaders/shared/ray_crossing.h): one invocation per edge.
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;

RayRef ray;
DexelEnd load_end(uint index) { return store.at[ray.first + index]; }
#include "shaders/shared/ray_crossing.h"

void main() {
    uint number = gl_GlobalInvocationID.x;
    uint end_of_list = min(counters.edges, parameters.most_edges);
    if (number >= end_of_list) return;
    uvec4 what = edges[number].what;
    uint slot = what.x;
    if (slot == kNoSlot) return;
    int axis = int(what.y & 3u);
    ivec3 node = first_node(jobs[slot].tile) + edge_node(what.y);
    bool lower_inside = lower_is_inside(what.y);
    ray = ray_at(axis, node[(axis + 1) % 3], node[(axis + 2) % 3]);
    EdgeCrossing crossing = edge_crossing(count_of(ray), axis, node[axis], lower_inside);
    Direction n = decode_normal(crossing.normal);
    edges[number].crossing = vec4(n.x, n.y, n.z, crossing.along);
    edges[number].what.w = crossing.material << 24 | tables[crossing.material].w;
    if (crossing.disagrees && what.z != kNotOwn) {
        edges[number].what.y = what.y | 1u << 18;
        atomicAdd(jobs[slot].disagreeing, 1u);
    }
}
