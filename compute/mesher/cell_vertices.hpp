// SPDX-License-Identifier: MIT
// Computes the surface vertices of one cell: one position for each loop of surface through it, and at that position one
// vertex for each smooth piece of surface that meets there, with the mean normal and colour of that piece. The rules
// are in shaders/shared: feature_point.h (positions), cell_pieces.h (number of vertices), cell_vertex.h (encoding).
// Thread-safe. Every tile that sees a cell computes the same bits for it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compute/mesher/cell_table.hpp"
#include "compute/mesher/tile_samples.hpp"
#include "compute/rays/solid.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::compute {

struct CellVertices {
    std::uint64_t of_edge;  // which vertex each edge and loop uses (TileMesh::vertex_of_edge)
    std::size_t count;
};

// Makes the vertices of the cells of one tile.
class CellVertexMaker {
public:
    static constexpr std::size_t kMost = 12;  // upper bound of vertices per cell: one for each crossing

    // The samples must have been collected, and must outlive this object unchanged.
    CellVertexMaker(const Solid& solid, const std::array<int, 3>& first_node, const TileSamples& samples)
        : samples_(samples),
          all_(samples.samples().data()),
          index_(samples.sample_indices()),
          materials_(solid.materials),
          spacing_m_(solid.lattice.spacing_m),
          first_node_(first_node) {}

    // Selects the column of cells that the next calls of make() refer to.
    void begin_column(int x, int y) {
        column_ = {x, y, 0};
        corners_ = samples_.corner_signs(x, y);
    }
    // Writes the vertices of the column's cell at height z, at most kMost of them. The samples must hold the crossings
    // of all edges of the cell.
    [[nodiscard]] CellVertices make(int z, shared::SurfaceVertex* vertices) const;
    // Returns the vertex half-way between two crossings on a face of the cell.
    [[nodiscard]] shared::SurfaceVertex make_face_vertex(const Local& cell, const EdgeSample& a,
                                                         const EdgeSample& b) const;

private:
    struct Loop;
    [[nodiscard]] CellVertices make_any(const CellCase& cell_case, const Local& cell, std::size_t lowest_edge,
                                        shared::SurfaceVertex* vertices) const;
    void collect(Loop& loop, std::size_t lowest_edge, const std::uint8_t* first, const std::uint8_t* end) const;
    [[nodiscard]] static bool alike(const Loop& loop, float length2);
    [[nodiscard]] bool make_smooth(const Local& cell, const Loop& loop, shared::SurfaceVertex& vertex) const;
    [[nodiscard]] shared::SurfaceVertex vertex_at(const Local& cell, const shared::Float3& in_cell,
                                                  const shared::Float3& normal_sum, float length,
                                                  std::uint32_t colour) const;

    const TileSamples& samples_;
    const EdgeSample* all_;
    const std::uint16_t* index_;
    const std::array<CellCase, 256>& table_ = cell_table();
    const std::vector<geometry::Material>& materials_;
    double spacing_m_;
    std::array<int, 3> first_node_;
    Local column_{};
    std::array<std::uint32_t, 4> corners_{};
};

}  // namespace burin::compute
