// SPDX-License-Identifier: MIT
#include "compute/mesher/made_tile.hpp"

#include "compute/mesher/cell_vertices.hpp"
#include "compute/mesher/tile_mesher.hpp"

namespace burin::compute {
namespace {

// The sum cannot overflow, as it is made of 64-bit numbers.
template <typename T>
bool holds(const std::vector<T>& list, std::uint64_t first, std::uint64_t count) {
    return first + count <= list.size();
}

bool is_good(const shared::MadeCell& cell, const std::vector<shared::SurfaceVertex>& vertices) {
    const std::size_t count = vertices_of(cell);
    return number_of(cell) < std::size_t{kSeenCells} * kSeenCells * kSeenCells && count > 0 &&
           count <= CellVertexMaker::kMost && holds(vertices, cell.first_vertex, count) &&
           (of_edge(cell) & TileMesh::kPassedTwice) == 0;
}

bool are_nodes(std::span<const std::uint32_t> signs) {
    std::uint32_t any = 0;
    for (const std::uint32_t column : signs) any |= column;
    return any >> kLocalNodes == 0;
}

}  // namespace

std::optional<MadePart> part_of(const MadeCells& made, const shared::MadeTile& tile) {
    if (!holds(made.cells, tile.first_cell, tile.cells) || !holds(made.edges, tile.first_edge, tile.edges)) return {};
    MadePart part{std::span(made.cells).subspan(tile.first_cell, tile.cells),
                  std::span(made.edges).subspan(tile.first_edge, tile.edges),
                  tile.signs,
                  made.vertices.data(),
                  {}};
    std::size_t least = 0;
    for (const shared::MadeCell& cell : part.cells) {
        const std::size_t number = number_of(cell);
        if (number < least || !is_good(cell, made.vertices)) return {};
        least = number + 1;
        part.mask.columns[number / kSeenCells] |= 1u << (number % kSeenCells);
    }
    if (!are_nodes(part.signs)) return {};
    return part;
}

}  // namespace burin::compute
