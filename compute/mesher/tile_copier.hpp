// SPDX-License-Identifier: MIT
// What stays of a tile's old mesh: the cells and quads that are not dirty, copied to the new one in long runs between those
// that are made anew, so that both come in their order.
#pragma once

#include <vector>

#include "compute/tile_draft.hpp"
#include "compute/tile_mesher.hpp"
#include "compute/tile_samples.hpp"

namespace burin {

class TileCopier {
public:
    // Reuses new_index. Where a loop passes a face twice, vertices and fans depend on the cells on both sides: these cells are
    // dirty in any case, and so fans are never copied.
    TileCopier(const TileMesh& old, const CellMask& dirty, TileDraft& draft, std::vector<std::uint32_t>& new_index);

    [[nodiscard]] const CellMask& dirty() const { return dirty_; }

    // Copies the clean cells before this one that are not there yet: first all cells.
    void copy_cells(std::size_t before);
    // Then the quads: those of the edges before this one.
    void copy_quads(std::size_t before);
    [[nodiscard]] std::uint32_t disagreeing_edges() const { return disagreeing_edges_; }  // of the copied quads

private:
    void copy_cell_run(std::size_t first, std::size_t end);
    void copy_quad_run(std::size_t first, std::size_t end);
    [[nodiscard]] std::size_t indices_of_quad_at(std::size_t index) const;

    const TileMesh& old_;
    TileDraft& draft_;
    std::vector<std::uint32_t>& new_index_;  // of each vertex of the old mesh
    CellMask dirty_;
    EdgeMask dirty_edges_;
    std::size_t cell_ = 0, quad_ = 0, index_ = 0;  // the next to copy or to leave out
    std::uint32_t disagreeing_edges_ = 0;
};

}  // namespace burin
