// SPDX-License-Identifier: MIT
// The polygon around a crossed lattice edge: the vertices of the four cells around it, counter-clockwise seen from the
// edge's upper end, and between two of them an extra vertex on their common face where a loop passes that face twice
// (compute/mesher/cell_table.hpp). Bit-identical on the CPU and on every device (portable.h).
#ifndef BURIN_SHARED_CELL_QUAD_H
#define BURIN_SHARED_CELL_QUAD_H
#include "shaders/shared/cell_row.h"
#include "shaders/shared/glm_names.h"
#include "shaders/shared/vectors.h"

BURIN_SHARED_BEGIN

// Offset of cell i = 0 .. 3 before the edge's lower node along axis + 1 and axis + 2.
BURIN_CONSTEXPR_FN int first_step_back(int i) { return i == 0 || i == 3 ? 1 : 0; }
BURIN_CONSTEXPR_FN int second_step_back(int i) { return i < 2 ? 1 : 0; }
// Returns the number of the crossed edge among cell i's edges.
BURIN_CONSTEXPR_FN int edge_of_quad(int axis, int i) {
    return cell_edge(axis, first_step_back(i), second_step_back(i));
}
// The face between cell i and the next: its axis, and on which side of cell i it lies.
BURIN_CONSTEXPR_FN int face_axis_of_quad(int axis, int i) { return (axis + 1 + (i & 1)) % 3; }
BURIN_CONSTEXPR_FN int face_side_of_quad(int i) { return i < 2 ? 1 : 0; }

// Tells whether both cells of a face have a loop that passes it twice, from the masks of their twice passed faces.
BURIN_FN bool passed_twice(uint twice_faces, uint twice_faces_of_next, int face_axis, int side) {
    return (twice_faces >> uint(cell_face(face_axis, side)) &
            twice_faces_of_next >> uint(cell_face(face_axis, 1 - side)) & 1u) != 0u;
}

BURIN_FN ivec3 along_axis(int axis, int by) {
    return ivec3(axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0);
}

// The extra vertex on the lower face (normal face_axis) of `cell` lies between the crossings of two edges of that face
// that meet in an inside corner: this one, from `node` along `axis`, and the other.
struct FaceJoin {
    ivec3 corner;
    ivec3 other_node;
    int other_axis;
};
BURIN_FN FaceJoin face_join(int axis, ivec3 node, bool node_is_inside, ivec3 cell, int face_axis) {
    FaceJoin join;
    join.corner = node_is_inside ? node : node + along_axis(axis, 1);
    join.other_axis = 3 - axis - face_axis;
    join.other_node = cell[join.other_axis] < join.corner[join.other_axis]
                          ? join.corner - along_axis(join.other_axis, 1)
                          : join.corner;
    return join;
}
// Returns the position of a crossing of the edge from `node` along `axis`, in cells from the cell's lowest corner.
BURIN_FN Float3 place_in_cell(ivec3 node, int axis, float along, ivec3 cell) {
    ivec3 from = node - cell;
    return Float3(axis == 0 ? float(from.x) + along : float(from.x), axis == 1 ? float(from.y) + along : float(from.y),
                  axis == 2 ? float(from.z) + along : float(from.z));
}
// Returns the midpoint. Symmetric in the two edges, so that both quads, in whatever tiles, compute the same bits.
BURIN_FN Float3 middle_of(Float3 a, Float3 b) {
    BURIN_PRECISE Float3 middle = (a + b) * 0.5f;
    return middle;
}

// Returns one coordinate of all corners relative to the quad's first corner, in cells, so that a workpiece of a
// micrometre does not underflow.
BURIN_HOT_FN Float4 from_first_corner(Float4 corners, float cells_per_m) {
    BURIN_PRECISE Float4 from = (corners - BURIN_SHUFFLED(corners, 0, 0, 0, 0)) * cells_per_m;
    return from;
}

// Returns the squared cosines, with their signs, between the quad's normal and the triangles (0, 1, 2) and (0, 2, 3) of
// the diagonal 0-2, (1, 2, 3) and (1, 3, 0) of the diagonal 1-3. They grow with the cosines and need no root. A
// triangle without area counts as facing away. x, y, z: results of from_first_corner.
BURIN_HOT_FN Float4 facings(Float4 x, Float4 y, Float4 z, float normal_x, float normal_y, float normal_z) {
    BURIN_PRECISE Float4 ax = BURIN_SHUFFLED(x, 1, 2, 2, 3) - BURIN_SHUFFLED(x, 0, 0, 1, 1);
    BURIN_PRECISE Float4 ay = BURIN_SHUFFLED(y, 1, 2, 2, 3) - BURIN_SHUFFLED(y, 0, 0, 1, 1);
    BURIN_PRECISE Float4 az = BURIN_SHUFFLED(z, 1, 2, 2, 3) - BURIN_SHUFFLED(z, 0, 0, 1, 1);
    BURIN_PRECISE Float4 bx = BURIN_SHUFFLED(x, 2, 3, 3, 0) - BURIN_SHUFFLED(x, 0, 0, 1, 1);
    BURIN_PRECISE Float4 by = BURIN_SHUFFLED(y, 2, 3, 3, 0) - BURIN_SHUFFLED(y, 0, 0, 1, 1);
    BURIN_PRECISE Float4 bz = BURIN_SHUFFLED(z, 2, 3, 3, 0) - BURIN_SHUFFLED(z, 0, 0, 1, 1);
    BURIN_PRECISE Float4 nx = ay * bz - by * az;
    BURIN_PRECISE Float4 ny = az * bx - bz * ax;
    BURIN_PRECISE Float4 nz = ax * by - bx * ay;
    BURIN_PRECISE Float4 along = nx * normal_x + ny * normal_y + nz * normal_z;
    BURIN_PRECISE Float4 length2 = nx * nx + ny * ny + nz * nz;
    BURIN_PRECISE Float4 cosine2 = exact_quotient(along * size_of_each(along), length2);
    return if_positive(length2, cosine2, -1.0f);
}
// Tells whether the diagonal 1-3 turns its two triangles less away from the outward normal than 0-2 does.
BURIN_HOT_FN bool takes_other_diagonal(Float4 facing) { return min(facing[0], facing[1]) < min(facing[2], facing[3]); }
// The quad's two triangles are (opening, second, third) and (opening, third, fourth) of its corners in this order.
BURIN_CONSTEXPR_FN uint opening_corner(bool other_diagonal) { return other_diagonal ? 1u : 0u; }
BURIN_CONSTEXPR_FN uint corner_after(uint opening, uint by) { return (opening + by) & 3u; }
// The second and the third corner of a triangle; swapped if `flip` is set, so that it faces the other way.
BURIN_CONSTEXPR_FN uint second_corner(uint second, uint third, bool flip) { return flip ? third : second; }
BURIN_CONSTEXPR_FN uint third_corner(uint second, uint third, bool flip) { return flip ? second : third; }

BURIN_SHARED_END
#endif
