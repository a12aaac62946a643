// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Turns the corners of the gathered triangles from the pool's vertices into the ball's: one invocation a corner.
#include "shaders/gather_buffers.glsl"

layout(local_size_x = 64) in;

void main() {
    uint end = 3u * min(counters.ball_triangles, uint(kBallTriangles));
    for (uint i = gl_GlobalInvocationID.x; i < end; i += 64u * gl_NumWorkGroups.x) {
        ball_triangles[i] = Members(parameters.member_address).at[ball_triangles[i]].number;
    }
}
