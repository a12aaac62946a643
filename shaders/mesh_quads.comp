// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// The triangles around each of a tile's own crossed edges, one invocation an edge: two between the vertices of the four cells
// about it, or a fan through the extra vertices of the faces that a loop passes twice (compute/tile_mesher.cpp). A fan's first
// two triangles take the quad's place, the others follow behind all quads.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_vertex.glsl"

layout(local_size_x = 64) in;

// 0: only quads; 1: only fans, run where there are any (see mesh_vertices.comp for the reason).
layout(constant_id = 0) const uint kFans = 0u;

bool inside(uint slot, ivec3 node) { return (jobs[slot].signs[node_column(node.x, node.y)] >> uint(node.z + 1) & 1u) != 0u; }

// What cells hold: the vertex of one of its edges; whether a face of one and of the next, which are the same, is passed twice.
uint vertex_of(uvec4 made, uint edge) {
    return made.z + ((edge < 8u ? made.x : made.y) >> (4u * (edge & 7u)) & 0xfu);
}
bool passed_twice(uvec4 made, uvec4 next, int axis, uint side) {
    uint face = 16u + uint(axis) * 2u;
    return ((made.w >> (face + side)) & (next.w >> (face + 1u - side)) & 1u) != 0u;
}

void write_triangle(uint place, uint a, uint b, uint c, bool flip) {
    pool_indices.at[place] = a;
    pool_indices.at[place + 1u] = flip ? c : b;
    pool_indices.at[place + 2u] = flip ? b : c;
}

// The middle between this edge's crossing and that of the other edge around the same inside corner of the cell's lower face.
void write_face_vertex(uint place, uint slot, int axis, ivec3 node, ivec3 cell, int face_axis, uint number) {
    ivec3 corner = inside(slot, node) ? node : node + along_axis(axis, 1);
    int other = 3 - axis - face_axis;
    ivec3 other_node = cell[other] < corner[other] ? corner - along_axis(other, 1) : corner;
    uint other_number = edge_number(slot, other, other_node);
    vec3 a = vec3(node - cell);
    vec3 b = vec3(other_node - cell);
    vec4 crossing = edges[number].crossing;
    vec4 other_crossing = edges[other_number].crossing;
    a[axis] += crossing.w;
    b[other] += other_crossing.w;
    write_vertex(place, cell + first_node(jobs[slot].tile), (a + b) * 0.5, crossing.xyz + other_crossing.xyz,
                 mean_colour(channels(edges[number].what.w) + channels(edges[other_number].what.w), 2u));
}

// The squared cosine between a triangle and the surface, with its sign.
float facing(vec3 a, vec3 b, vec3 c, vec3 normal) {
    vec3 n = cross3(b - a, c - a);
    float along = dot3(n, normal);
    float length2 = dot3(n, n);
    precise float cosine2 = along * abs(along) / length2;
    return length2 > 0.0 ? cosine2 : -1.0;
}

vec3 place_of(uint vertex) {
    return vec3(pool_vertices.at[vertex].x, pool_vertices.at[vertex].y, pool_vertices.at[vertex].z);
}
vec3 in_cells(vec3 place, vec3 origin, float cells_per_m) {
    precise vec3 p = (place - origin) * cells_per_m;
    return p;
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
    // Counter-clockwise seen from the edge's upper end.
    ivec3 around[4];
    around[0] = node - along_axis(u, 1) - along_axis(v, 1);
    around[1] = node - along_axis(v, 1);
    around[2] = node;
    around[3] = node - along_axis(u, 1);
    uvec4 made[4];
    for (int i = 0; i < 4; ++i) made[i] = cells[cell_number(slot, around[i])].made;
    uint first_edge = uint(axis) * 4u;
    uint corners[4];
    corners[0] = vertex_of(made[0], first_edge + 3u);
    corners[1] = vertex_of(made[1], first_edge + 2u);
    corners[2] = vertex_of(made[2], first_edge);
    corners[3] = vertex_of(made[3], first_edge + 1u);
    bool flip = !lower_is_inside(what.y);  // the surface faces the lower end
    uint place = ranges[tile].first_index + 6u * quad;
    uint first_vertex = uint(ranges[tile].first_vertex);

    uint twice = 0u;  // bit i: the face between cells i and i + 1 has an extra vertex
    for (int i = 0; i < 4; ++i) {
        if (passed_twice(made[i], made[(i + 1) & 3], i % 2 == 0 ? u : v, i < 2 ? 1u : 0u)) twice |= 1u << i;
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
            int face_axis = i % 2u == 0u ? u : v;
            ivec3 upper = i < 2u ? around[i] + along_axis(face_axis, 1) : around[i];
            write_face_vertex(first_vertex + next_extra, slot, axis, node, upper, face_axis, number);
            last_extra = count;
            polygon[count++] = next_extra++;
        }
        // From the last extra vertex: no diagonal of this fan can be an edge of another polygon.
        uint behind = ranges[tile].first_index + 6u * jobs[slot].quads + 3u * made;
        for (uint i = 1u; i + 1u < count; ++i) {
            write_triangle(i < 3u ? place + 3u * (i - 1u) : behind + 3u * (i - 3u), polygon[last_extra],
                           polygon[(last_extra + i) % count], polygon[(last_extra + i + 1u) % count], flip);
        }
        return;
    }
    if (extras > 0u) return;
    float cells_per_m = float(1.0lf / parameters.spacing_m);
    vec3 origin = place_of(first_vertex + corners[0]);
    vec3 p0 = vec3(0.0);
    vec3 p1 = in_cells(place_of(first_vertex + corners[1]), origin, cells_per_m);
    vec3 p2 = in_cells(place_of(first_vertex + corners[2]), origin, cells_per_m);
    vec3 p3 = in_cells(place_of(first_vertex + corners[3]), origin, cells_per_m);
    vec3 upwards = edges[number].crossing.xyz;
    vec3 normal = flip ? -upwards : upwards;
    bool other_diagonal = min(facing(p0, p1, p2, normal), facing(p0, p2, p3, normal)) <
                          min(facing(p1, p2, p3, normal), facing(p1, p3, p0, normal));
    uint second = other_diagonal ? corners[2] : corners[1];
    uint third = other_diagonal ? corners[3] : corners[2];
    uint fourth = other_diagonal ? corners[0] : corners[3];
    uint opening = other_diagonal ? corners[1] : corners[0];
    write_triangle(place, opening, second, third, flip);
    write_triangle(place + 3u, opening, third, fourth, flip);
}
