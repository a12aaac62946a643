// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
// Maps the corners of the gathered triangles from the pool's vertices to the ball's: one invocation per triangle.
#include "shaders/gather_buffers.glsl"

layout(local_size_x = 64) in;

void main() {
    Members members = Members(parameters.member_address);
    // With more triangles than there is room for, the last entries may never have been written, and the host discards
    // the ball: nothing is mapped.
    uint end = counters.ball_triangles > parameters.most_triangles ? 0u : counters.ball_triangles;
    for (uint i = gl_GlobalInvocationID.x; i < end; i += 64u * gl_NumWorkGroups.x) {
        uvec3 corners = ball_triangles[i];
        ball_triangles[i] =
            uvec3(members.at[corners.x].number, members.at[corners.y].number, members.at[corners.z].number);
    }
}
