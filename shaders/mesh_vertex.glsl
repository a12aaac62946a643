// SPDX-License-Identifier: MIT
// Writes a vertex of the surface as compute/cell_vertices.cpp makes it. Needs mesh_buffers.glsl.

// size * 32767 / length1 rounded to nearest, halves up: exact in doubles for numbers as small as these, since a quotient is on
// a half or at least 1 / (2 length1) away from it. (Software drivers divide 64-bit integers one at a time.)
int nearest_share(int size, double length1) { return int((double(size) * 65534.0lf + length1) / (2.0lf * length1)); }

// The code that encode_normal gives for n in units of 2^-20.
uint encode_float_normal(vec3 n) {
    float length2 = dot3(n, n);
    precise vec3 unit = sqrt(length2) > 1e-6 ? n * (1.0 / sqrt(length2)) : vec3(0.0, 0.0, 1.0);
    ivec3 whole = ivec3(unit * 1048576.0);
    ivec3 size = abs(whole);
    double length1 = double(size.x + size.y + size.z);
    int a = nearest_share(size.x, length1);
    int b = nearest_share(size.y, length1);
    int folded_a = whole.z < 0 ? 32767 - b : a;  // the lower half is folded outwards
    int folded_b = whole.z < 0 ? 32767 - a : b;
    if (whole.x < 0 && a != 0) folded_a = -folded_a;  // a part that was rounded to zero has lost its sign
    if (whole.y < 0 && b != 0) folded_b = -folded_b;
    return uint(folded_b + 32767) << 16 | uint(folded_a + 32767);
}

// `in_cell` is in cells from the cell's lowest corner; `cell` is counted from the lattice's origin, so that every tile that
// shares the vertex rounds it to the same bits.
void write_vertex(uint place, ivec3 cell, vec3 in_cell, vec3 normal, uint colour) {
    pool_vertices.at[place].x = float((double(in_cell.x) + double(cell.x)) * parameters.spacing_m);
    pool_vertices.at[place].y = float((double(in_cell.y) + double(cell.y)) * parameters.spacing_m);
    pool_vertices.at[place].z = float((double(in_cell.z) + double(cell.z)) * parameters.spacing_m);
    pool_vertices.at[place].normal = encode_float_normal(normal);
    pool_vertices.at[place].colour = colour;
}

uvec3 channels(uint colour) { return uvec3(colour & 0xffu, colour >> 8 & 0xffu, colour >> 16 & 0xffu); }
uint mean_colour(uvec3 sum, uint count) {
    uvec3 mean = (sum + count / 2u) / count;
    return mean.x | mean.y << 8 | mean.z << 16 | 0xff000000u;
}
