// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Copies the vertices of the cells that no changed ray reaches from the tile's old range to its new one, one invocation
// per cell.
#include "shaders/mesh_buffers.glsl"

layout(local_size_x = 64) in;

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= counters.kept_cells) return;
    number = lists[parameters.most_cells - 1u - number];
    uvec4 what = cells[number].what;
    uint slot = what.x;
    if (jobs[slot].waits != 0u) return;
    uvec4 made = cells[number].made;
    uint first_vertex = uint(ranges[jobs[slot].tile].first_vertex);
    uint from = jobs[slot].old_vertex + what.z;
    uint to = first_vertex + made.z;
    uint end = to + vertices_in(made.w);
    for (; to < end; ++from, ++to) pool_vertices.at[to] = pool_vertices.at[from];
    keep_cell(slot, first_vertex, number, what.y, made);
}
