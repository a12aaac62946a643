// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// The triangles whose box comes within a ball, by the pool's vertices, and the places of these relative to the ball's centre
// (compute/local_surface.cpp): one work group a tile. What is too much is counted all the same.
#include "shaders/gather_buffers.glsl"

layout(local_size_x = 64) in;

Vertices pool_vertices = Vertices(parameters.vertex_address);
Indices pool_indices = Indices(parameters.index_address);
Members members = Members(parameters.member_address);

vec3 place_of(uint vertex) {
    return vec3(pool_vertices.at[vertex].x, pool_vertices.at[vertex].y, pool_vertices.at[vertex].z);
}

void take(uint vertex, vec3 place) {
    if (atomicExchange(members.at[vertex].stamp, parameters.stamp) == parameters.stamp) return;
    uint number = atomicAdd(counters.ball_vertices, 1u);
    members.at[vertex].number = number;
    if (number >= uint(kBallVertices)) return;
    ball_places[3u * number] = float(double(place.x) - parameters.center[0]);
    ball_places[3u * number + 1u] = float(double(place.y) - parameters.center[1]);
    ball_places[3u * number + 2u] = float(double(place.z) - parameters.center[2]);
}

void main() {
    int group = int(gl_WorkGroupID.x);
    ivec3 at = ivec3(group % parameters.count[0], group / parameters.count[0] % parameters.count[1],
                     group / (parameters.count[0] * parameters.count[1]));
    at += ivec3(parameters.from[0], parameters.from[1], parameters.from[2]);
    int tile = (at.z * parameters.tiles[1] + at.y) * parameters.tiles[0] + at.x;
    uint first_vertex = uint(ranges[tile].first_vertex);
    uint first_index = ranges[tile].first_index;
    uint end = ranges[tile].index_count;
    vec3 center = vec3(parameters.center_float[0], parameters.center_float[1], parameters.center_float[2]);
    // A tile's triangles reach at most one and a half cells beyond its own; two, for the rounding.
    vec3 tile_lo = (vec3(at * kMeshTile) - 2.0) * parameters.spacing_m;
    vec3 tile_hi = (vec3(at * kMeshTile + kMeshTile) + 2.0) * parameters.spacing_m;
    vec3 to_tile = max(max(tile_lo - center, center - tile_hi), vec3(0.0));
    if (dot(to_tile, to_tile) > parameters.radius_m * parameters.radius_m) end = 0u;
    for (uint i = 3u * gl_LocalInvocationID.x; i < end; i += 3u * 64u) {
        uint a = first_vertex + pool_indices.at[first_index + i];
        uint b = first_vertex + pool_indices.at[first_index + i + 1u];
        uint c = first_vertex + pool_indices.at[first_index + i + 2u];
        vec3 pa = place_of(a);
        vec3 pb = place_of(b);
        vec3 pc = place_of(c);
        vec3 lo = min(pa, min(pb, pc));
        vec3 hi = max(pa, max(pb, pc));
        vec3 outside = max(max(lo - center, center - hi), vec3(0.0));
        precise float distance2 = outside.x * outside.x + outside.y * outside.y + outside.z * outside.z;
        precise float reach2 = parameters.radius_m * parameters.radius_m;
        if (distance2 > reach2) continue;
        uint number = atomicAdd(counters.ball_triangles, 1u);
        if (number >= uint(kBallTriangles)) continue;
        take(a, pa);
        take(b, pb);
        take(c, pc);
        ball_triangles[3u * number] = a;
        ball_triangles[3u * number + 1u] = b;
        ball_triangles[3u * number + 2u] = c;
    }
}
