// SPDX-License-Identifier: MIT
// The table of surface topology: how the surface passes through one lattice cell, for each of the 256 patterns of
// inside and outside corners. Corners, edges and faces are numbered as in shaders/shared/cell_row.h, which also packs
// the table for the device.
//
// An edge is crossed when its two corners differ. On each face the crossed edges are joined in pairs: two crossed edges
// with each other; on an ambiguous face (four crossed edges) the two around each INSIDE corner. Both cells of a face
// see the same corners, so they join alike. Every crossed edge lies on two faces of the cell, so the joins form closed
// loops. Each loop gets one vertex (dual marching cubes; Nielson 2004).
//
// Why the mesh is two-manifold: around a vertex the quads follow its loop, one after the other, and close. Two quads
// share the mesh edge that belongs to their join. Only where a loop passes one face twice, in both cells of that face,
// would two joins produce the same mesh edge and four quads meet there; each such join gets a vertex of its own on the
// face (tile_mesher.cpp), and again two quads share an edge. This covers all patterns, so nothing needs repair
// afterwards.
#pragma once

#include <array>
#include <cstdint>

namespace burin::compute {

inline constexpr std::uint8_t kNotCrossed = 0xff;

struct CellCase {
    std::uint8_t loops = 0;                       // 0 to 4 closed loops of surface
    std::array<std::uint8_t, 12> loop_of_edge{};  // the loop that passes the edge, or kNotCrossed
    std::uint8_t twice_faces = 0;                 // bit f: one loop passes face f twice
    // Lists the crossed edges loop by loop, in increasing order within each loop.
    std::array<std::uint8_t, 12> edges{};
    std::array<std::uint8_t, 5> first_edge{};  // loop l consists of edges[first_edge[l] .. first_edge[l + 1])
    // Value of TileMesh::vertex_of_edge for a cell that has a single vertex: every crossed edge uses vertex 0.
    std::uint64_t all_use_first = 0;
};

// Indexed by the corner pattern: bit c is set when corner c is inside.
[[nodiscard]] const std::array<CellCase, 256>& cell_table();

}  // namespace burin::compute
