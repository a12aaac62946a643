// SPDX-License-Identifier: MIT
// The numbering of a cell's corners, edges and faces, and the cell table (compute/mesher/cell_table.hpp) packed as the
// device reads it.
//
// Corner c has offset (c & 1, c >> 1 & 1, c >> 2 & 1). Edge axis * 4 + o1 + 2 * o2 runs along `axis` at offset o1 along
// axis + 1 and o2 along axis + 2 (cyclic). Face axis * 2 + side has `axis` as its normal.
#ifndef BURIN_SHARED_CELL_ROW_H
#define BURIN_SHARED_CELL_ROW_H
#include "shaders/shared/glm_names.h"
#include "shaders/shared/vectors.h"

BURIN_SHARED_BEGIN

BURIN_CONSTEXPR_FN int cell_edge(int axis, int o1, int o2) { return axis * 4 + o1 + 2 * o2; }
BURIN_CONSTEXPR_FN int axis_of_edge(uint edge) { return int(edge >> 2); }
BURIN_CONSTEXPR_FN int first_offset(uint edge) { return int(edge & 1u); }
BURIN_CONSTEXPR_FN int second_offset(uint edge) { return int(edge >> 1 & 1u); }
BURIN_CONSTEXPR_FN int cell_face(int axis, int side) { return axis * 2 + side; }

// Returns a position on an edge, `along` from 0 at its lower node to 1 at the upper; in cells from the cell's lowest
// corner.
BURIN_CONSTEXPR_FN Float3 place_on_edge(uint edge, float along) {
    float u = float(first_offset(edge));
    float v = float(second_offset(edge));
    return edge < 4u ? Float3(along, u, v) : (edge < 8u ? Float3(v, along, u) : Float3(u, v, along));
}

// A row of the packed table. x, y: edges[0 .. 7], edges[8 .. 11] in 4 bits each, and from bit 16 of y on
// first_edge[1 .. 4]; z: loops in 4 bits, and twice_faces; w: the colour of the material of the row's number.
BURIN_FN uvec4 row_with_edge(uvec4 row, uint i, uint edge) {
    uint bits = edge << (4u * (i & 7u));
    return uvec4(i < 8u ? row.x | bits : row.x, i < 8u ? row.y : row.y | bits, row.z, row.w);
}
BURIN_FN uvec4 row_with_first(uvec4 row, uint loop, uint first_edge) {
    return uvec4(row.x, row.y | first_edge << (12u + 4u * loop), row.z, row.w);
}
BURIN_FN uvec4 row_with_loops(uvec4 row, uint loops, uint twice_faces) {
    return uvec4(row.x, row.y, loops | twice_faces << 4, row.w);
}
BURIN_FN uint listed_edge(uvec4 row, uint i) { return (i < 8u ? row.x : row.y) >> (4u * (i & 7u)) & 0xfu; }
BURIN_FN uint first_listed(uvec4 row, uint loop) { return loop == 0u ? 0u : row.y >> (12u + 4u * loop) & 0xfu; }
BURIN_FN uint loops_of(uvec4 row) { return row.z & 0xfu; }
BURIN_FN uint twice_faces_of(uvec4 row) { return row.z >> 4; }

BURIN_SHARED_END
#endif
