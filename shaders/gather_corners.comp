// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
// Turns the corners of the gathered triangles from the pool's vertices into the ball's: one invocation a triangle.
#include "shaders/gather_buffers.glsl"

layout(local_size_x = 64) in;

void main() {
    Members members = Members(parameters.member_address);
    uint end = min(counters.ball_triangles, uint(kBallTriangles));
    for (uint i = gl_GlobalInvocationID.x; i < end; i += 64u * gl_NumWorkGroups.x) {
        uvec3 corners = ball_triangles[i];
        ball_triangles[i] =
            uvec3(members.at[corners.x].number, members.at[corners.y].number, members.at[corners.z].number);
    }
}
