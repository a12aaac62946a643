// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
// Gathers the triangles whose box comes within a ball, as indices of the pool's vertices, and the positions of these
// vertices relative to the ball's centre (compute/mesher/local_surface.cpp): one work group per tile. What exceeds the
// capacity is still counted.
#include "shaders/gather_buffers.glsl"

layout(local_size_x = 64) in;

Vertices pool_vertices = Vertices(parameters.vertex_address);
Members members = Members(parameters.member_address);

// 1: the binding covers the whole pool of vertices.
layout(constant_id = 0) const uint kBound = 0u;

vec3 place_of(uint vertex) { return kBound == 1u ? bound_vertices[vertex].place : pool_vertices.at[vertex].place; }

void take(uint vertex, vec3 place) {
    if (atomicExchange(members.at[vertex].stamp, parameters.stamp) == parameters.stamp) return;
    uint number = atomicAdd(counters.ball_vertices, 1u);
    members.at[vertex].number = number;
    if (number >= parameters.most_vertices) return;
    ball_places[number] =
        vec3(float(double(place.x) - parameters.center[0]), float(double(place.y) - parameters.center[1]),
             float(double(place.z) - parameters.center[2]));
}

// Tells whether the box around a triangle comes within the ball.
bool near(vec3 a, vec3 b, vec3 c, vec3 center) {
    vec3 lo = min(a, min(b, c));
    vec3 hi = max(a, max(b, c));
    vec3 outside = max(max(lo - center, center - hi), vec3(0.0));
    precise float distance2 = outside.x * outside.x + outside.y * outside.y + outside.z * outside.z;
    precise float reach2 = parameters.radius_m * parameters.radius_m;
    return distance2 <= reach2;
}

void main() {
    int group = int(gl_WorkGroupID.x);
    ivec3 at = ivec3(group % parameters.count[0], group / parameters.count[0] % parameters.count[1],
                     group / (parameters.count[0] * parameters.count[1]));
    at += ivec3(parameters.from[0], parameters.from[1], parameters.from[2]);
    int tile = (at.z * parameters.tiles[1] + at.y) * parameters.tiles[0] + at.x;
    uint first_vertex = uint(ranges[tile].first_vertex);
    TrianglePairs pairs = TrianglePairs(parameters.index_address + 4ul * ranges[tile].first_index);
    uint end = ranges[tile].index_count / 3u;
    vec3 center = vec3(parameters.center_float[0], parameters.center_float[1], parameters.center_float[2]);
    // A tile's triangles reach at most one and a half cells beyond its own cells; two allow for the rounding.
    vec3 tile_lo = (vec3(at * kMeshTile) - 2.0) * parameters.spacing_m;
    vec3 tile_hi = (vec3(at * kMeshTile + kMeshTile) + 2.0) * parameters.spacing_m;
    vec3 to_tile = max(max(tile_lo - center, center - tile_hi), vec3(0.0));
    if (dot(to_tile, to_tile) > parameters.radius_m * parameters.radius_m) end = 0u;
    // Tests two triangles at a time: those of a quad, or two of a fan, share their first corner and another one.
    for (uint i = 2u * gl_LocalInvocationID.x; i < end; i += 128u) {
        TrianglePair pair = pairs.at[i / 2u];
        bool two = i + 1u < end;
        bool shares_c = two && pair.d == pair.a && pair.e == pair.c;
        bool shares_b = two && pair.d == pair.a && pair.f == pair.b;
        bool alone = two && !shares_b && !shares_c;  // the second triangle is tested in an iteration of its own
        uvec3 corners = uvec3(pair.a, pair.b, pair.c);
        uint fourth = shares_b ? pair.e : (shares_c ? pair.f : pair.a);
        for (;;) {
            uint a = first_vertex + corners.x;
            uint b = first_vertex + corners.y;
            uint c = first_vertex + corners.z;
            uint d = first_vertex + fourth;
            vec3 at_a = place_of(a);
            vec3 at_b = place_of(b);
            vec3 at_c = place_of(c);
            vec3 at_d = place_of(d);
            bool first = near(at_a, at_b, at_c, center);
            bool second = (shares_b || shares_c) && near(at_a, shares_b ? at_b : at_c, at_d, center);
            uint taken = (first ? 1u : 0u) + (second ? 1u : 0u);
            uint number = taken > 0u ? atomicAdd(counters.ball_triangles, taken) : 0u;
            if (taken > 0u && number + taken <= parameters.most_triangles) {
                take(a, at_a);
                if (first || shares_b) take(b, at_b);
                if (first || shares_c) take(c, at_c);
                if (second) take(d, at_d);
                if (first) ball_triangles[number] = uvec3(a, b, c);
                if (second) ball_triangles[number + taken - 1u] = shares_b ? uvec3(a, d, b) : uvec3(a, c, d);
            }
            if (!alone) break;
            corners = uvec3(pair.d, pair.e, pair.f);
            fourth = pair.d;
            alone = false;
        }
    }
}
