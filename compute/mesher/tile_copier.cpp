// SPDX-License-Identifier: MIT
#include "compute/mesher/tile_copier.hpp"

namespace burin::compute {

TileCopier::TileCopier(const TileMesh& old, const CellMask& dirty, TileDraft& draft,
                       std::vector<std::uint32_t>& new_index)
    : old_(old), draft_(draft), new_index_(new_index), dirty_(dirty) {
    new_index_.resize(old.vertices.size());
    if (!old.face_keys.empty()) {
        for (std::size_t i = 0; i < old.cells.size(); ++i) {
            if ((old.vertex_of_edge[i] & TileMesh::kPassedTwice) != 0) {
                dirty_.columns[old.cells[i].cell / kSeenCells] |= 1u << (old.cells[i].cell % kSeenCells);
            }
        }
    }
    dirty_edges_ = edges_of(dirty_);
}

void TileCopier::copy_cells(std::size_t before) {
    const std::size_t end = old_.cells.size();
    const auto is_dirty = [&](std::size_t place) {
        const std::size_t id = old_.cells[place].cell;
        return (dirty_.columns[id / kSeenCells] >> (id % kSeenCells) & 1u) != 0;
    };
    while (cell_ < end && old_.cells[cell_].cell < before) {
        const std::size_t first = cell_;
        while (cell_ < end && old_.cells[cell_].cell < before && !is_dirty(cell_)) ++cell_;
        if (cell_ > first) {
            copy_cell_run(first, cell_);
        } else {
            ++cell_;
        }
    }
}

void TileCopier::copy_cell_run(std::size_t first, std::size_t end) {
    draft_.vertex_of_edge.append(&old_.vertex_of_edge[first], end - first);
    if (old_.has_twice_passed_faces) {
        for (std::size_t i = first; i < end; ++i)
            has_copied_twice_passed_faces_ |= (old_.vertex_of_edge[i] & TileMesh::kPassedTwice) != 0;
    }
    const std::size_t old_vertex = old_.cells[first].first_vertex, new_vertex = draft_.vertices.count;
    const std::size_t vertices =
        (end < old_.cells.size() ? old_.cells[end].first_vertex : old_.cell_vertices()) - old_vertex;
    draft_.vertices.append(&old_.vertices[old_vertex], vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        new_index_[old_vertex + v] = static_cast<std::uint32_t>(new_vertex + v);
    }
    for (std::size_t i = first; i < end; ++i) {
        draft_.begin_cell(old_.cells[i].cell, old_.cells[i].first_vertex + new_vertex - old_vertex);
    }
}

void TileCopier::copy_quads(std::size_t before) {
    const std::size_t end = old_.quads.size();
    const auto edge_of = [&](std::size_t quad) { return std::size_t{old_.quads[quad]} & TileMesh::kQuadEdge; };
    const auto is_dirty = [&](std::size_t edge) {
        const std::size_t row = edge / kTileCells / kTileCells, x = edge / kTileCells % kTileCells;
        const NodeColumns& along = dirty_edges_[row / kTileCells];
        return (along[TileSamples::column(static_cast<int>(x), static_cast<int>(row % kTileCells))] >>
                    (edge % kTileCells + 1) &
                1u) != 0;
    };
    while (quad_ < end && edge_of(quad_) < before) {
        const std::size_t first = quad_;
        while (quad_ < end && edge_of(quad_) < before && !is_dirty(edge_of(quad_))) ++quad_;
        if (quad_ > first) {
            copy_quad_run(first, quad_);
        } else {
            index_ += indices_of_quad_at(index_);
            ++quad_;
        }
    }
}

void TileCopier::copy_quad_run(std::size_t first, std::size_t end) {
    draft_.quads.append(&old_.quads[first], end - first);
    if (old_.disagreeing_edges != 0) {
        for (std::size_t i = first; i < end; ++i) {
            disagreeing_edges_ += (old_.quads[i] & TileMesh::kDisagrees) != 0 ? 1 : 0;
        }
    }
    const std::size_t count = 6 * (end - first);
    const std::uint32_t* const from = &old_.indices[index_];
    std::uint32_t* const to = draft_.indices.add(count);
    for (std::size_t i = 0; i < count; ++i) to[i] = new_index_[from[i]];
    index_ += count;
}

// Returns the number of indices of one quad or fan. The triangles of a fan all begin with its own extra vertex.
std::size_t TileCopier::indices_of_quad_at(std::size_t index) const {
    const std::uint32_t first = old_.indices[index];
    if (first < old_.cell_vertices()) return 6;
    std::size_t count = 3;
    while (index + count < old_.indices.size() && old_.indices[index + count] == first) count += 3;
    return count;
}

}  // namespace burin::compute
