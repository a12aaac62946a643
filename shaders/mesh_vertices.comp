// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Writes the vertices of each cell that is made anew, one invocation per cell, by the rules of
// shaders/shared/feature_point.h and cell_vertex.h: bit-identical to the host's.
#include "shaders/mesh_buffers.glsl"
#include "shaders/mesh_vertex.glsl"
#include "shaders/shared/feature_planes.h"

layout(local_size_x = 64) in;

// 0: cells whose planes determine a point in closed form; the others are listed. 1: those on that list. Software
// drivers run both sides of every branch, so rare and long code must not stand beside the usual one.
layout(constant_id = 0) const uint kListed = 0u;

uvec4 row;  // table row of the cell's pattern (cell_row.h)
float along[12];
vec3 normal[12];
uint colour[12];

Float3 crossing_place(uint i) { return place_on_edge(listed_edge(row, i), along[i]); }
Float3 crossing_normal(uint i) { return normal[i]; }
#include "shaders/shared/feature_point.h"

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= (kListed == 1u ? counters.hard_cells : counters.made_cells)) return;
    number = kListed == 1u ? hard[number] : lists[number];
    uvec4 what = cells[number].what;
    uint slot = what.x;
    if (jobs[slot].waits != 0u) return;
    uint tile = jobs[slot].tile;
    ivec3 cell = cell_place(what.y);
    ivec3 cell_in_lattice = cell + first_node(tile);
    uvec4 made = cells[number].made;
    uint first_vertex = uint(ranges[tile].first_vertex);
    uint first_place = first_vertex + made.z;
    if (kListed == 0u) keep_cell(slot, first_vertex, number, what.y, made);
    row = tables[pattern_of(what.y)];
    uint loops = loops_of(row);
    uint next_vertex = 0u;
    bool is_hard = false;
    for (uint loop = 0u; loop < loops; ++loop) {
        uint first = first_listed(row, loop);
        uint last = first_listed(row, loop + 1u);
        uint end_vertex = loop + 1u < loops ? made.y >> (20u + 4u * loop) & 0xfu : vertices_in(made.w);
        precise vec3 place_sum = vec3(0.0);
        for (uint i = first; i < last; ++i) {
            uint crossing = sample_of(slot, cell, listed_edge(row, i));
            vec4 normal_along = edges[crossing].crossing;
            normal[i] = normal_along.xyz;
            along[i] = normal_along.w;
            colour[i] = edges[crossing].what.w;
            place_sum += crossing_place(i);
        }
        precise vec3 mean = exact_quotient(place_sum, float(last - first));
        ClosedForm planes = offset_to_planes(first, last, mean);
        vec3 offset = planes.offset;
        if (kListed == 1u && !planes.found) offset = offset_by_eigenvalues(first, last, mean);
        vec3 in_cell = place_from_mean(mean, offset);
        is_hard = is_hard || !planes.found;
        while (next_vertex < end_vertex) {
            precise vec3 normal_sum = vec3(0.0);
            ColourSum colour_sum = no_colour();
            for (uint i = first; i < last; ++i) {
                uint edge = listed_edge(row, i);
                if (((edge < 8u ? made.x : made.y) >> (4u * (edge & 7u)) & 0xfu) != next_vertex) continue;
                normal_sum += normal[i];
                colour_sum = with_packed_colour(colour_sum, colour[i]);
            }
            write_vertex(first_place + next_vertex, cell_in_lattice, in_cell, normal_sum, colour_sum);
            ++next_vertex;
        }
    }
    if (kListed == 0u && is_hard) {
        uint place = atomicAdd(counters.hard_cells, 1u);
        hard[place] = number;
        atomicMax(counters.hard_groups[0], (place + 64u) / 64u);
    }
}
