// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_buffer_reference : require
// Makes the vertices of each listed cell, one invocation per cell: one for each smooth piece of each loop of surface
// (shaders/shared/cell_pieces.h), by the rules of feature_point.h and cell_vertex.h there, bit-identical to the host's.
// Cells with a face that a loop passes twice leave their tile to the host.
#include "shaders/cell_buffers.glsl"
#include "shaders/shared/cell_quad.h"
#include "shaders/shared/cell_vertex.h"
#include "shaders/shared/feature_planes.h"

layout(local_size_x = 64) in;

// 0: cells whose planes determine a point in closed form; the others are listed. 1: those on that list, whose vertices
// have their places. Software drivers run both sides of every branch, so rare and long code must not stand beside the
// usual one.
layout(constant_id = 0) const uint kListed = 0u;

#include "shaders/shared/cell_pieces.h"

uvec4 row;  // table row of the cell's pattern (cell_row.h)
float along[12];
vec3 normal[12];
uint colour[12];

Float3 crossing_place(uint i) { return place_on_edge(listed_edge(row, i), along[i]); }
Float3 crossing_normal(uint i) { return normal[i]; }
#include "shaders/shared/feature_point.h"

// Returns the number of a crossed edge of the cell in the list of edges.
uint crossing_of(uint slot, ivec3 cell, uint edge) {
    int axis = axis_of_edge(edge);
    ivec3 offset = along_axis((axis + 1) % 3, first_offset(edge)) + along_axis((axis + 2) % 3, second_offset(edge));
    ivec3 node = cell + offset;
    uvec2 column = tiles[slot].edge_columns[axis * kNodeColumns + node_column(node.x, node.y)];
    return column.y + uint(bitCount(column.x & below(node.z)));
}

ColourSum with_packed_colour(ColourSum sum, uint colour) {
    return with_colour(sum, colour & 0xffu, colour >> 8 & 0xffu, colour >> 16 & 0xffu);
}

// The cell's vertices: which of them each edge uses, and the first of each loop (MadeCell::of_edge_low and _high).
uint of_edge_low;
uint of_edge_high;
uint vertices;

void number_vertices(uint slot, ivec3 cell, uint loops) {
    of_edge_low = 0xffffffffu;
    of_edge_high = 0xfffeffffu;  // no loop passes a face twice
    vertices = 0u;
    for (uint loop = 0u; loop < loops; ++loop) {
        uint last = first_listed(row, loop + 1u);
        pieces = 0u;
        if (loop > 0u)
            of_edge_high = (of_edge_high & ~(0xfu << (16u + 4u * loop))) | vertices << (16u + 4u * loop);
        for (uint i = first_listed(row, loop); i < last; ++i) {
            uint edge = listed_edge(row, i);
            uint crossing = crossing_of(slot, cell, edge);
            vec4 normal_along = edges[crossing].crossing;
            normal[i] = normal_along.xyz;
            along[i] = normal_along.w;
            colour[i] = edges[crossing].what.w;
            uint p = piece_of(normal[i], colour[i] >> 24);
            uint shift = 4u * (edge & 7u);
            uint used = (vertices + p) << shift;
            of_edge_low = edge < 8u ? (of_edge_low & ~(0xfu << shift)) | used : of_edge_low;
            of_edge_high = edge < 8u ? of_edge_high : (of_edge_high & ~(0xfu << shift)) | used;
        }
        vertices += pieces;
    }
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= (kListed == 1u ? counters.hard_cells : min(counters.cells, parameters.most_cells))) return;
    if (kListed == 1u) number = hard[number];
    uvec2 what = cells[number].what;
    uint slot = what.x;
    if (slot == kNoSlot) return;
    ivec3 cell = cell_place(what.y);
    ivec3 cell_in_lattice = cell + first_node(tiles[slot].tile);
    row = tables[pattern_of(what.y)];
    uint loops = loops_of(row);
    number_vertices(slot, cell, loops);
    uint first_vertex = 0u;
    if (kListed == 1u) {
        first_vertex = made_cells[number].first_vertex;
    } else {
        first_vertex = atomicAdd(counters.vertices, vertices);
        made_cells[number] =
            MadeCell((what.y & 0xffffu) | vertices << 16, first_vertex, of_edge_low, of_edge_high);
        if (first_vertex + vertices > parameters.most_vertices || twice_faces_of(row) != 0u) {
            made_tiles[slot].left = 1u;
            return;
        }
    }
    uint next_vertex = 0u;
    bool is_hard = false;
    for (uint loop = 0u; loop < loops; ++loop) {
        uint first = first_listed(row, loop);
        uint last = first_listed(row, loop + 1u);
        uint end_vertex = loop + 1u < loops ? of_edge_high >> (20u + 4u * loop) & 0xfu : vertices;
        precise vec3 place_sum = vec3(0.0);
        for (uint i = first; i < last; ++i) place_sum += crossing_place(i);
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
                if (((edge < 8u ? of_edge_low : of_edge_high) >> (4u * (edge & 7u)) & 0xfu) != next_vertex) continue;
                normal_sum += normal[i];
                colour_sum = with_packed_colour(colour_sum, colour[i]);
            }
            made_vertices[first_vertex + next_vertex] =
                cell_vertex(cell_in_lattice.x, cell_in_lattice.y, cell_in_lattice.z, parameters.spacing_m, in_cell,
                            normal_sum, length3(normal_sum), mean_colour(colour_sum));
            ++next_vertex;
        }
    }
    if (kListed == 0u && is_hard) {
        uint place = atomicAdd(counters.hard_cells, 1u);
        hard[place] = number;
        atomicMax(counters.hard_groups[0], (place + 64u) / 64u);
    }
}
