// SPDX-License-Identifier: MIT
// Writes a vertex of the surface (shaders/shared/cell_vertex.h). Needs mesh_buffers.glsl.
#include "shaders/shared/cell_vertex.h"

// `in_cell` is in cells from the cell's lowest corner; `cell` is counted from the lattice's origin.
void write_vertex(uint place, ivec3 cell, vec3 in_cell, vec3 normal_sum, ColourSum colour) {
    pool_vertices.at[place] = cell_vertex(cell.x, cell.y, cell.z, parameters.spacing_m, in_cell, normal_sum,
                                          length3(normal_sum), mean_colour(colour));
}

ColourSum with_packed_colour(ColourSum sum, uint colour) {
    return with_colour(sum, colour & 0xffu, colour >> 8 & 0xffu, colour >> 16 & 0xffu);
}
