// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Writes the triangles around each of a tile's own crossed edges whose four cells are kept, one invocation per edge.
// Their diagonal is kept too, so no place of a vertex is read.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_triangle.glsl"

layout(local_size_x = 64) in;

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= min(counters.kept_quads, parameters.most_edges)) return;
    uvec2 quad = kept_quads[number];
    uint slot = quad.x;
    if (slot == kNoSlot) return;
    if (jobs[slot].waits != 0u) return;
    int axis = int(quad.y & 3u);
    ivec3 node = edge_node(quad.y);
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    uint corners[4];
    uint bits = 0u;
    for (int i = 0; i < 4; ++i) {
        ivec3 cell = node - along_axis(u, first_step_back(i)) - along_axis(v, second_step_back(i));
        uvec4 made = cells[cell_number(slot, cell)].made;
        corners[i] = vertex_of(made, uint(edge_of_quad(axis, i)));
        bits = i == 2 ? made.w : bits;  // those of the cell at the node
    }
    bool other = (bits >> (kOtherDiagonals + uint(axis)) & 1u) != 0u;
    uint place = ranges[jobs[slot].tile].first_index + 6u * (quad.y >> 18);
    write_quad(place, corners, opening_corner(other), !lower_is_inside(quad.y));
}
