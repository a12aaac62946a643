// SPDX-License-Identifier: MIT
// Writes a vertex of the surface as compute/cell_vertices.cpp makes it. Needs mesh_buffers.glsl.

uint encode_float_normal(vec3 n) {
    float length2 = dot3(n, n);
    precise vec3 unit = sqrt(length2) > 1e-6 ? n * (1.0 / sqrt(length2)) : vec3(0.0, 0.0, 1.0);
    IntVector whole;
    whole.x = int64_t(unit.x * 1048576.0);
    whole.y = int64_t(unit.y * 1048576.0);
    whole.z = int64_t(unit.z * 1048576.0);
    return encode_normal(whole);
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

uvec3 colour_of(uint edge) {
    uint colour = tables[kColourTable + (edges[edge].material_disagrees & 0xffu)];
    return uvec3(colour & 0xffu, colour >> 8 & 0xffu, colour >> 16 & 0xffu);
}
uint mean_colour(uvec3 sum, uint count) {
    uvec3 mean = (sum + count / 2u) / count;
    return mean.x | mean.y << 8 | mean.z << 16 | 0xff000000u;
}
