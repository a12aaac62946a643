// SPDX-License-Identifier: MIT
#include "compute/mesher/made_tile.hpp"

#include <array>

#include "compute/mesher/cell_table.hpp"
#include "compute/mesher/cell_vertices.hpp"
#include "compute/mesher/tile_mesher.hpp"

namespace burin::compute {
namespace {

// The sum cannot overflow, as it is made of 64-bit numbers.
template <typename T>
bool holds(const std::vector<T>& list, std::uint64_t first, std::uint64_t count) {
    return first + count <= list.size();
}

constexpr std::size_t kCells = std::size_t{kSeenCells} * kSeenCells * kSeenCells;

// Tells whether the crossed edges, and they alone, use one of the cell's vertices, `count` in number.
bool uses_vertices(std::uint64_t of_edge, std::size_t count, const CellCase& cell_case) {
    constexpr std::uint64_t kEdges = (std::uint64_t{1} << 48) - 1u, kEach = 0x010101010101u;
    const std::uint64_t others = cell_case.all_use_first & kEdges;
    if ((of_edge & others) != others) return false;
    // Every second edge has a byte of its own, whose bit 4 is set by the sum where the vertex is `count` or above.
    const std::uint64_t used = of_edge & kEdges & ~others, add = (16 - count) * kEach;
    const std::uint64_t even = used & (0x0f * kEach), odd = used >> 4 & (0x0f * kEach);
    return (((even + add) | (odd + add)) & (0x10 * kEach)) == 0;
}

unsigned pattern_of(std::size_t number, std::span<const std::uint32_t> signs) {
    const std::size_t column = number / kSeenCells;
    const std::uint32_t* const corner = &signs[column / kSeenCells * kLocalNodes + column % kSeenCells];
    return TileSamples::cell_pattern({corner[0], corner[1], corner[kLocalNodes], corner[kLocalNodes + 1]},
                                     static_cast<int>(number % kSeenCells) - 1);
}

// Tells whether a face that a loop passes twice in this cell is passed twice in the cell beyond it, too.
bool has_fan(std::size_t number, const CellCase& cell_case, std::span<const std::uint32_t> signs) {
    // Steps between the numbers of neighbours along x, y and z; a number over its step, modulo, is the place.
    constexpr std::array<std::size_t, 3> kStep{kSeenCells, std::size_t{kSeenCells} * kSeenCells, 1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t place = number / kStep[axis] % kSeenCells;
        for (std::size_t side = 0; side < 2; ++side) {
            if ((cell_case.twice_faces >> (2 * axis + side) & 1u) == 0) continue;
            if (place == (side == 0 ? 0 : kSeenCells - 1)) continue;  // its edges are another tile's
            const std::size_t next = side == 0 ? number - kStep[axis] : number + kStep[axis];
            if ((cell_table()[pattern_of(next, signs)].twice_faces >> (2 * axis + 1 - side) & 1u) != 0) return true;
        }
    }
    return false;
}

bool is_good(const shared::MadeCell& cell, std::span<const std::uint32_t> signs,
             const std::vector<shared::SurfaceVertex>& vertices) {
    const std::size_t number = number_of(cell), count = vertices_of(cell);
    if (number >= kCells || count == 0 || count > CellVertexMaker::kMost) return false;
    if (!holds(vertices, cell.first_vertex, count)) return false;
    const CellCase& cell_case = cell_table()[pattern_of(number, signs)];
    const bool is_said = (of_edge(cell) & TileMesh::kPassedTwice) != 0;
    if (is_said != (cell_case.twice_faces != 0) || !uses_vertices(of_edge(cell), count, cell_case)) return false;
    return !is_said || !has_fan(number, cell_case, signs);
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
    if (!are_nodes(part.signs)) return {};
    std::size_t least = 0;
    for (const shared::MadeCell& cell : part.cells) {
        const std::size_t number = number_of(cell);
        if (number < least || !is_good(cell, part.signs, made.vertices)) return {};
        least = number + 1;
        part.mask.columns[number / kSeenCells] |= 1u << (number % kSeenCells);
    }
    return part;
}

}  // namespace burin::compute
