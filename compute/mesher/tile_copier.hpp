// SPDX-License-Identifier: MIT
// Copies the clean part of a tile's old mesh, the cells and quads that are not dirty, to the new one. Long runs are
// copied between the cells and quads that are recomputed, so that the result is in order.
#pragma once

#include <vector>

#include "compute/mesher/tile_draft.hpp"
#include "compute/mesher/tile_mesher.hpp"
#include "compute/mesher/tile_samples.hpp"

namespace burin::compute {

class TileCopier {
public:
    // Uses new_index as scratch memory. Where a loop passes a face twice, vertices and fans depend on the cells on both
    // sides: these cells are always treated as dirty, so fans are never copied.
    TileCopier(const TileMesh& old, const CellMask& dirty, TileDraft& draft, std::vector<std::uint32_t>& new_index);

    [[nodiscard]] const CellMask& dirty() const { return dirty_; }
    [[nodiscard]] const EdgeMask& dirty_edges() const { return dirty_edges_; }  // all edges of the dirty cells

    // Copies the clean cells with an id below `before` that have not been copied yet. All cells come before the first
    // quad.
    void copy_cells(std::size_t before);
    // Copies the clean quads of the lattice edges below `before` that have not been copied yet.
    void copy_quads(std::size_t before);
    [[nodiscard]] std::uint32_t disagreeing_edges() const { return disagreeing_edges_; }  // among the copied quads

private:
    void copy_cell_run(std::size_t first, std::size_t end);
    void copy_quad_run(std::size_t first, std::size_t end);
    [[nodiscard]] std::size_t indices_of_quad_at(std::size_t index) const;

    const TileMesh& old_;
    TileDraft& draft_;
    std::vector<std::uint32_t>& new_index_;  // new index of each vertex of the old mesh
    CellMask dirty_;
    EdgeMask dirty_edges_;
    std::size_t cell_ = 0, quad_ = 0, index_ = 0;  // next cell, quad and index of the old mesh to copy or skip
    std::uint32_t disagreeing_edges_ = 0;
};

}  // namespace burin::compute
