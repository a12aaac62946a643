// SPDX-License-Identifier: MIT
// The surface vertices of one cell: one place for each loop of the surface through it, and there one vertex for each smooth
// piece of surface that meets, with the mean normal and colour of that piece.
// Thread-safe. In the same cell every tile that sees it computes the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compute/solid.hpp"
#include "compute/tile_samples.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

// Appends the vertices; returns which of them each edge and loop uses (TileMesh::vertex_of_edge). The samples must hold the
// crossings of all the cell's edges.
[[nodiscard]] std::uint64_t make_cell_vertices(const Solid& solid, const std::array<int, 3>& first_node,
                                               const TileSamples& samples, const Local& cell,
                                               std::vector<shared::SurfaceVertex>& vertices);

struct EdgeCrossing {
    int axis;
    Local node;
    const EdgeSample& sample;
};

// Half-way between two crossings on a face of the cell.
[[nodiscard]] shared::SurfaceVertex make_face_vertex(const Solid& solid, const std::array<int, 3>& first_node,
                                                     const Local& cell, const EdgeCrossing& a, const EdgeCrossing& b);

}  // namespace burin
