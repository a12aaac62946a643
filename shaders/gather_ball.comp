// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
// The triangles whose box comes within a ball, by the pool's vertices, and the places of these relative to the ball's centre
// (compute/local_surface.cpp): one work group a tile. What is too much is counted all the same.
#include "shaders/gather_buffers.glsl"

layout(local_size_x = 64) in;

Vertices pool_vertices = Vertices(parameters.vertex_address);
Members members = Members(parameters.member_address);

void take(uint vertex, vec3 place) {
    if (atomicExchange(members.at[vertex].stamp, parameters.stamp) == parameters.stamp) return;
    uint number = atomicAdd(counters.ball_vertices, 1u);
    members.at[vertex].number = number;
    if (number >= uint(kBallVertices)) return;
    ball_places[number] = vec3(float(double(place.x) - parameters.center[0]), float(double(place.y) - parameters.center[1]),
                               float(double(place.z) - parameters.center[2]));
}

void main() {
    int group = int(gl_WorkGroupID.x);
    ivec3 at = ivec3(group % parameters.count[0], group / parameters.count[0] % parameters.count[1],
                     group / (parameters.count[0] * parameters.count[1]));
    at += ivec3(parameters.from[0], parameters.from[1], parameters.from[2]);
    int tile = (at.z * parameters.tiles[1] + at.y) * parameters.tiles[0] + at.x;
    uint first_vertex = uint(ranges[tile].first_vertex);
    Triangles triangles = Triangles(parameters.index_address + 4ul * ranges[tile].first_index);
    uint end = ranges[tile].index_count / 3u;
    vec3 center = vec3(parameters.center_float[0], parameters.center_float[1], parameters.center_float[2]);
    // A tile's triangles reach at most one and a half cells beyond its own; two, for the rounding.
    vec3 tile_lo = (vec3(at * kMeshTile) - 2.0) * parameters.spacing_m;
    vec3 tile_hi = (vec3(at * kMeshTile + kMeshTile) + 2.0) * parameters.spacing_m;
    vec3 to_tile = max(max(tile_lo - center, center - tile_hi), vec3(0.0));
    if (dot(to_tile, to_tile) > parameters.radius_m * parameters.radius_m) end = 0u;
    for (uint i = gl_LocalInvocationID.x; i < end; i += 64u) {
        uvec3 corners = triangles.at[i] + first_vertex;
        vec3 a = pool_vertices.at[corners.x].place;
        vec3 b = pool_vertices.at[corners.y].place;
        vec3 c = pool_vertices.at[corners.z].place;
        vec3 lo = min(a, min(b, c));
        vec3 hi = max(a, max(b, c));
        vec3 outside = max(max(lo - center, center - hi), vec3(0.0));
        precise float distance2 = outside.x * outside.x + outside.y * outside.y + outside.z * outside.z;
        precise float reach2 = parameters.radius_m * parameters.radius_m;
        if (distance2 > reach2) continue;
        uint number = atomicAdd(counters.ball_triangles, 1u);
        if (number >= uint(kBallTriangles)) continue;
        take(corners.x, a);
        take(corners.y, b);
        take(corners.z, c);
        ball_triangles[number] = corners;
    }
}
