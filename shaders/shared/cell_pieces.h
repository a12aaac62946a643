// SPDX-License-Identifier: MIT
// Numbers the smooth pieces of one loop of surface through a cell: a crossing belongs to the first piece whose first
// crossing is similar to it (in_one_piece), or starts a new piece. Included inside a C++ struct or at the top level of
// a shader, after cell_vertex.h.

uint pieces;  // number of pieces so far; set it to 0 before each loop
// Normal and material of each piece's first crossing. The first piece, usually the only one, is kept apart: software
// drivers index arrays one invocation after the other.
Float3 opening_normal;
uint opening_material;
Float3 piece_normal[12];
uint piece_material[12];

// Returns the piece of the loop's next crossing.
BURIN_FN uint piece_of(Float3 normal, uint material) {
    if (pieces == 0u) {
        opening_normal = normal;
        opening_material = material;
        pieces = 1u;
        return 0u;
    }
    if (in_one_piece(opening_normal, opening_material, normal, material)) return 0u;
    uint p = 1u;
    while (p < pieces && !in_one_piece(piece_normal[p], piece_material[p], normal, material)) ++p;
    if (p == pieces) {
        piece_normal[p] = normal;
        piece_material[p] = material;
        ++pieces;
    }
    return p;
}
