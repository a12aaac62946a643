// SPDX-License-Identifier: MIT
// Writes the triangles of a quad (shaders/shared/cell_quad.h). Needs mesh_buffers.glsl.

void write_triangle(uint place, uint a, uint b, uint c, bool flip) {
    pool_indices.at[place] = a;
    pool_indices.at[place + 1u] = second_corner(b, c, flip);
    pool_indices.at[place + 2u] = third_corner(b, c, flip);
}
void write_quad(uint place, uint corners[4], uint opening, bool flip) {
    uint third = corners[corner_after(opening, 2u)];
    write_triangle(place, corners[opening], corners[corner_after(opening, 1u)], third, flip);
    write_triangle(place + 3u, corners[opening], third, corners[corner_after(opening, 3u)], flip);
}
