// SPDX-License-Identifier: MIT
// How the surface passes through one lattice cell, for each of the 256 patterns of inside and outside corners.
//
// Numbering: corner c has offset (c & 1, c >> 1 & 1, c >> 2 & 1). Edge axis * 4 + o1 + 2 * o2 runs along `axis` at offset o1
// along axis + 1 and o2 along axis + 2 (cyclic). Face axis * 2 + side has `axis` as its normal.
//
// An edge is crossed when its corners differ. On each face the crossed edges are joined in pairs: two crossed edges with
// each other; on an ambiguous face (four crossed edges) the two around each INSIDE corner. Both cells of a face see the same
// corners, so they join alike. Every crossed edge lies on two faces of the cell, so the joins form closed loops. Each loop
// gets one vertex (dual marching cubes; Nielson 2004).
//
// Why the mesh is two-manifold: around a vertex the quads follow its loop, one after the other, and close. Two quads share
// the mesh edge that belongs to their join. Only where a loop passes one face twice, in both cells of that face, would two
// joins make the same mesh edge and four quads meet there; then each join gets a vertex of its own on the face
// (tile_mesher.cpp), and again two quads share an edge. No pattern is left over, so nothing needs repair afterwards.
#pragma once

#include <array>
#include <cstdint>

namespace burin {

inline constexpr std::uint8_t kNotCrossed = 0xff;

struct CellCase {
    std::uint8_t loops = 0;                       // 0 to 4
    std::array<std::uint8_t, 12> loop_of_edge{};  // kNotCrossed or the loop
    std::uint8_t twice_faces = 0;                 // bit f: face f is passed twice by one loop
    std::array<std::uint8_t, 12> edges{};         // the crossed edges, loop by loop, in each loop in increasing order
    std::array<std::uint8_t, 5> first_edge{};     // loop l has edges[first_edge[l] .. first_edge[l + 1])
    std::uint64_t all_use_first = 0;              // TileMesh::vertex_of_edge when there is one vertex for all edges
};

// Indexed by the corner pattern: bit c is set when corner c is inside.
[[nodiscard]] const std::array<CellCase, 256>& cell_table();

[[nodiscard]] constexpr int cell_edge(int axis, int o1, int o2) { return axis * 4 + o1 + 2 * o2; }
[[nodiscard]] constexpr int cell_face(int axis, int side) { return axis * 2 + side; }

}  // namespace burin
