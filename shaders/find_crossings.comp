// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Computes where the surface crosses each lattice edge, and with which normal and material
// (shaders/shared/ray_crossing.h): one invocation per edge.
#include "shaders/cell_buffers.glsl"

layout(local_size_x = 64) in;

RayRef ray;
DexelEnd load_end(uint index) { return store.at[ray.first + index]; }
#include "shaders/shared/ray_crossing.h"

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= min(counters.edges, parameters.most_edges)) return;
    uvec4 what = edges[number].what;
    uint slot = what.x;
    if (slot == kNoSlot) return;
    int axis = int(what.y & 3u);
    ivec3 in_tile = edge_node(what.y);
    ivec3 node = first_node(tiles[slot].tile) + in_tile;
    bool lower_inside = lower_is_inside(what.y);
    ray = ray_at(axis, node[(axis + 1) % 3], node[(axis + 2) % 3]);
    EdgeCrossing crossing = edge_crossing(count_of(ray), axis, node[axis], lower_inside);
    Direction n = decode_normal(crossing.normal);
    edges[number].crossing = vec4(n.x, n.y, n.z, crossing.along);
    edges[number].what.w = crossing.material << 24 | tables[crossing.material].w;
    if (what.z == kNotOwn) return;
    uint own = uint(((axis * kMeshTile + in_tile.y) * kMeshTile + in_tile.x) * kMeshTile + in_tile.z);
    made_edges[what.z] =
        MadeEdge(own | (crossing.disagrees ? 0x8000u : 0u) | (lower_inside ? 0x10000u : 0u), crossing.normal);
}
