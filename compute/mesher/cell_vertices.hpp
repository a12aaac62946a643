// SPDX-License-Identifier: MIT
// The surface vertices of one cell: one place for each loop of the surface through it, and there one vertex for each smooth
// piece of surface that meets, with the mean normal and colour of that piece.
// Thread-safe. In the same cell every tile that sees it computes the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compute/cell_table.hpp"
#include "compute/solid.hpp"
#include "compute/tile_samples.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

struct CellVertices {
    std::uint64_t of_edge;  // which of them each edge and loop uses (TileMesh::vertex_of_edge)
    std::size_t count;
};

// Of the cells of one tile.
class CellVertexMaker {
public:
    static constexpr std::size_t kMost = 12;  // of a cell: no more than crossings

    // The samples must have been collected, and stay as they are.
    CellVertexMaker(const Solid& solid, const std::array<int, 3>& first_node, const TileSamples& samples)
        : samples_(samples),
          all_(samples.samples().data()),
          index_(samples.sample_indices()),
          materials_(solid.materials),
          spacing_m_(solid.lattice.spacing_m),
          first_node_(first_node) {}

    // The cells that are asked for next are in this column.
    void begin_column(int x, int y) {
        column_ = {x, y, 0};
        corners_ = samples_.corner_signs(x, y);
    }
    // Writes the vertices of the column's cell at height z, kMost at most. The samples must hold the crossings of all its edges.
    [[nodiscard]] CellVertices make(int z, shared::SurfaceVertex* vertices) const;
    // The vertex half-way between two crossings on a face of the cell.
    [[nodiscard]] shared::SurfaceVertex make_face_vertex(const Local& cell, const EdgeSample& a,
                                                         const EdgeSample& b) const;

private:
    struct Loop;
    [[nodiscard]] CellVertices make_any(const CellCase& cell_case, const Local& cell, std::size_t lowest_edge,
                                        shared::SurfaceVertex* vertices) const;
    void collect(Loop& loop, std::size_t lowest_edge, const std::uint8_t* first, const std::uint8_t* end) const;
    [[nodiscard]] static bool alike(const Loop& loop, float length2);
    [[nodiscard]] bool make_smooth(const Local& cell, const Loop& loop, shared::SurfaceVertex& vertex) const;
    [[nodiscard]] shared::SurfaceVertex vertex_at(const Local& cell, const Vec3f& in_cell, const Vec3f& normal_sum,
                                                  float length, std::uint32_t colour) const;

    const TileSamples& samples_;
    const EdgeSample* all_;
    const std::uint16_t* index_;
    const std::array<CellCase, 256>& table_ = cell_table();
    const std::vector<Material>& materials_;
    double spacing_m_;
    std::array<int, 3> first_node_;
    Local column_{};
    std::array<std::uint32_t, 4> corners_{};
};

}  // namespace burin
