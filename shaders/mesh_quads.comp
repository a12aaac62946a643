// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Writes the triangles around each of a tile's own crossed edges beside a cell that is made anew, one invocation per
// edge: two between the vertices of the four cells around it, or a fan through the extra vertices of the faces that a
// loop passes twice (shaders/shared/cell_quad.h). A fan's first two triangles take the quad's place, the others follow
// behind all quads.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_triangle.glsl"
#include "shaders/mesh_vertex.glsl"

layout(local_size_x = 64) in;

// 0: only quads; 1: only fans, run where there are any (mesh_vertices.comp gives the reason).
layout(constant_id = 0) const uint kFans = 0u;

bool inside(uint slot, ivec3 node) {
    return (jobs[slot].signs[node_column(node.x, node.y)] >> uint(node.z + 1) & 1u) != 0u;
}

// Returns the faces that a loop passes twice, from MeshCell::made.
uint twice_faces_made(uvec4 made) { return made.w >> 16; }

// Writes the extra vertex for the join of this edge on the lower face of the cell.
void write_face_vertex(uint place, uint slot, int axis, ivec3 node, ivec3 cell, int face_axis, uint number) {
    FaceJoin join = face_join(axis, node, inside(slot, node), cell, face_axis);
    uint other_number = edge_number(slot, join.other_axis, join.other_node);
    vec4 crossing = edges[number].crossing;
    vec4 other_crossing = edges[other_number].crossing;
    vec3 middle = middle_of(place_in_cell(node, axis, crossing.w, cell),
                            place_in_cell(join.other_node, join.other_axis, other_crossing.w, cell));
    ColourSum one = with_packed_colour(no_colour(), edges[number].what.w);
    ColourSum colour = with_packed_colour(one, edges[other_number].what.w);
    write_vertex(place, cell + first_node(jobs[slot].tile), middle, crossing.xyz + other_crossing.xyz, colour);
}

vec3 place_of(uint vertex) {
    return vec3(pool_vertices.at[vertex].x, pool_vertices.at[vertex].y, pool_vertices.at[vertex].z);
}
void main() {
    uint number = gl_GlobalInvocationID.x;
    uint end_of_list = min(counters.edges, parameters.most_edges);
    if (number >= end_of_list) return;
    uvec4 what = edges[number].what;
    uint slot = what.x;
    if (slot == kNoSlot) return;
    uint quad = what.z;
    if (quad == kNotOwn || jobs[slot].waits != 0u) return;
    uint tile = jobs[slot].tile;
    int axis = int(what.y & 3u);
    ivec3 node = edge_node(what.y);
    int u = (axis + 1) % 3;
    int v = (axis + 2) % 3;
    ivec3 around[4];
    uvec4 made[4];
    uint corners[4];
    for (int i = 0; i < 4; ++i) {
        around[i] = node - along_axis(u, first_step_back(i)) - along_axis(v, second_step_back(i));
        made[i] = cells[cell_number(slot, around[i])].made;
        corners[i] = vertex_of(made[i], uint(edge_of_quad(axis, i)));
    }
    bool flip = !lower_is_inside(what.y);  // the surface faces the lower end
    uint place = ranges[tile].first_index + 6u * quad;
    uint first_vertex = uint(ranges[tile].first_vertex);

    uint twice = 0u;  // bit i: the face between cells i and i + 1 has an extra vertex
    for (int i = 0; i < 4; ++i) {
        if (passed_twice(twice_faces_made(made[i]), twice_faces_made(made[(i + 1) & 3]), face_axis_of_quad(axis, i),
                         face_side_of_quad(i))) {
            twice |= 1u << i;
        }
    }
    uint extras = uint(bitCount(twice));
    if (kFans == 1u) {
        if (extras == 0u) return;
        uint polygon[8];
        uint count = 0u;
        uint last_extra = 0u;
        uint made = atomicAdd(jobs[slot].extras_made, extras);
        uint next_extra = jobs[slot].cell_vertices + made;
        for (uint i = 0u; i < 4u; ++i) {
            polygon[count++] = corners[i];
            if ((twice >> i & 1u) == 0u) continue;
            int face_axis = face_axis_of_quad(axis, int(i));
            ivec3 upper = around[i] + along_axis(face_axis, face_side_of_quad(int(i)));
            write_face_vertex(first_vertex + next_extra, slot, axis, node, upper, face_axis, number);
            last_extra = count;
            polygon[count++] = next_extra++;
        }
        // The fan starts from the last extra vertex, so none of its diagonals can be an edge of another polygon.
        uint behind = ranges[tile].first_index + 6u * jobs[slot].quads + 3u * made;
        for (uint i = 1u; i + 1u < count; ++i) {
            write_triangle(i < 3u ? place + 3u * (i - 1u) : behind + 3u * (i - 3u), polygon[last_extra],
                           polygon[(last_extra + i) % count], polygon[(last_extra + i + 1u) % count], flip);
        }
        return;
    }
    if (extras > 0u) return;
    float cells_per_m = float(1.0lf / parameters.spacing_m);
    vec3 p0 = place_of(first_vertex + corners[0]);
    vec3 p1 = place_of(first_vertex + corners[1]);
    vec3 p2 = place_of(first_vertex + corners[2]);
    vec3 p3 = place_of(first_vertex + corners[3]);
    vec4 x = from_first_corner(vec4(p0.x, p1.x, p2.x, p3.x), cells_per_m);
    vec4 y = from_first_corner(vec4(p0.y, p1.y, p2.y, p3.y), cells_per_m);
    vec4 z = from_first_corner(vec4(p0.z, p1.z, p2.z, p3.z), cells_per_m);
    vec3 upwards = edges[number].crossing.xyz;
    vec3 normal = flip ? -upwards : upwards;
    bool other = takes_other_diagonal(facings(x, y, z, normal.x, normal.y, normal.z));
    write_quad(place, corners, opening_corner(other), flip);
    uint kept = (other ? 1u << kOtherDiagonals : 0u) | (what.y >> 18 & 1u) << kDisagreements;
    uint cell = first_vertex + cell_number(slot, node) - jobs[slot].first_cell;
    if (kept != 0u) atomicOr(pool_kept.at[cell].w, kept << axis);
}
