// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Where the surface crosses each lattice edge, and with which normal and material: one invocation an edge.
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;

const uint kNoEnd = 0xffffffffu;

// The end that makes the crossing of the edge between nodes `lower` and `lower + 1` (compute/tile_samples.cpp).
uint crossing_end(RayRef ray, int lower, bool lower_inside) {
    int edge_lo = lower * kUnitsPerCell;
    int edge_hi = edge_lo + kUnitsPerCell;
    uint best = kNoEnd;
    int best_distance = kNearEdgeUnits;
    uint count = count_of(ray);
    for (uint i = lower_inside ? 1u : 0u; i < count; i += 2u) {
        int depth = depth_of(store.at[ray.first + i]);
        if (depth >= edge_hi + kNearEdgeUnits) break;
        int distance = depth <= edge_lo ? edge_lo - depth + 1 : max(depth - edge_hi, 0);
        if (distance < best_distance || (distance == 0 && best_distance == 0 && !lower_inside)) {
            best = i;
            best_distance = distance;
        }
    }
    return best;
}

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
    RayRef ray = ray_at(axis, node[(axis + 1) % 3], node[(axis + 2) % 3]);
    uint chosen = crossing_end(ray, node[axis], lower_inside);
    uint material = 0u;
    uint code = axis_normal(axis, lower_inside);
    float along = 0.5;
    bool disagrees = true;
    if (chosen != kNoEnd) {
        DexelEnd end = store.at[ray.first + chosen];
        int offset = depth_of(end) - node[axis] * kUnitsPerCell;
        along = float(clamp(offset, 0, kUnitsPerCell)) / float(kUnitsPerCell);
        code = end.normal;
        material = material_of(end);
        disagrees = offset <= 0 || offset > kUnitsPerCell;
    }
    Direction n = decode_normal(code);
    edges[number].crossing = vec4(n.x, n.y, n.z, along);
    edges[number].what.w = material << 24 | tables[material].w;
    if (disagrees && what.z != kNotOwn) atomicAdd(jobs[slot].disagreeing, 1u);
}
