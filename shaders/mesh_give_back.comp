// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Puts the ranges that tiles no longer need on the lists of free ones: one invocation per tile. Ranges are taken in
// mesh_sizes.comp only, so the lists need no locks.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_ranges.glsl"

layout(local_size_x = 1) in;

void main() {
    uint slot = gl_WorkGroupID.x;
    give_back(0u, jobs[slot].old_vertex_class, jobs[slot].old_vertex);
    give_back(1u, jobs[slot].old_index_class, jobs[slot].old_index);
}
