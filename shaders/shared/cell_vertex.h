// SPDX-License-Identifier: MIT
// The vertices of one cell: how many smooth pieces of surface meet there, and the vertex of each. Bit-identical on the
// CPU and on every device (portable.h), and in every tile that sees the cell.
#ifndef BURIN_SHARED_CELL_VERTEX_H
#define BURIN_SHARED_CELL_VERTEX_H
#include "shaders/shared/direction_code.h"
#include "shaders/shared/feature_constants.h"
#include "shaders/shared/glm_names.h"
#include "shaders/shared/surface_vertex.h"
#include "shaders/shared/vectors.h"

BURIN_SHARED_BEGIN

// Tells whether a crossing belongs to the piece of surface that starts with the first one.
BURIN_FN bool in_one_piece(Float3 first_normal, uint first_material, Float3 normal, uint material) {
    return dot3(first_normal, normal) >= (first_material == material ? kSmooth : kSmoothAcrossMaterials);
}

// A sum of colours: three channels of 8 bits, red in the lowest byte.
struct ColourSum {
    uint red;
    uint green;
    uint blue;
    uint count;
};
BURIN_HOT_FN ColourSum no_colour() {
    ColourSum sum;
    sum.red = 0u;
    sum.green = 0u;
    sum.blue = 0u;
    sum.count = 0u;
    return sum;
}
BURIN_HOT_FN ColourSum with_colour(ColourSum sum, uint red, uint green, uint blue) {
    sum.red += red;
    sum.green += green;
    sum.blue += blue;
    sum.count += 1u;
    return sum;
}
BURIN_HOT_FN uint mean_colour(ColourSum sum) {
    uint half_count = sum.count / 2u;
    return (sum.red + half_count) / sum.count | (sum.green + half_count) / sum.count << 8 |
           (sum.blue + half_count) / sum.count << 16 | 0xff000000u;
}

BURIN_HOT_FN float metres_of(float in_cell, int cell, double spacing_m) {
    return float((double(in_cell) + double(cell)) * spacing_m);
}

// Returns the code of the mean direction of unit normals; `length` is that of their sum. The direction is truncated to
// whole 2^-20s, from which direction_code makes the same bits everywhere. Normals that cancel give +z.
BURIN_HOT_FN uint mean_direction_code(Float3 normal_sum, float length) {
    BURIN_PRECISE Float3 unit = length > 1e-6f ? normal_sum * exact_quotient(1.0f, length) : Float3(0.0f, 0.0f, 1.0f);
    BURIN_PRECISE Float3 scaled = unit * 1048576.0f;
    return direction_code(int(scaled[0]), int(scaled[1]), int(scaled[2]));
}

// Returns the vertex at `in_cell`, in cells from the cell's lowest corner. The cell (x, y, z) is counted from the
// lattice's origin and not from the tile's, so that every tile that shares the vertex rounds it to the same bits.
BURIN_HOT_FN SurfaceVertex cell_vertex(int x, int y, int z, double spacing_m, Float3 in_cell, Float3 normal_sum,
                                       float length, uint colour) {
    SurfaceVertex vertex;
    vertex.x = metres_of(in_cell[0], x, spacing_m);
    vertex.y = metres_of(in_cell[1], y, spacing_m);
    vertex.z = metres_of(in_cell[2], z, spacing_m);
    vertex.normal = mean_direction_code(normal_sum, length);
    vertex.colour = colour;
    return vertex;
}

BURIN_SHARED_END
#endif
