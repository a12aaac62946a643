// SPDX-License-Identifier: MIT
#include "compute/mesher/tile_samples.hpp"

#include <algorithm>
#include <bit>

#include "shaders/shared/octahedral.h"

namespace burin::shared {
namespace {

// Adapts a ray in host memory to shaders/shared/ray_crossing.h.
struct MeshedRay {
    const DexelEnd* ends;
    [[nodiscard]] DexelEnd load_end(uint i) const { return ends[i]; }
#include "shaders/shared/ray_crossing.h"
};

}  // namespace
}  // namespace burin::shared

namespace burin::compute {
namespace {

using shared::DexelEnd;

// Finds the crossing of the edge from node `lower` of this ray. The sample's axis and lower_inside must be set.
[[gnu::always_inline]] inline void read_crossing(std::span<const DexelEnd> ends, int lower, EdgeSample& sample) {
    shared::MeshedRay ray{ends.data()};
    const auto crossing =
        ray.edge_crossing(static_cast<std::uint32_t>(ends.size()), sample.axis, lower, sample.lower_inside);
    sample.along = crossing.along;
    sample.material = static_cast<std::uint8_t>(crossing.material);
    sample.disagrees = crossing.disagrees;
    const shared::Direction n = shared::decode_normal(crossing.normal);
    sample.normal = {n.x, n.y, n.z};
}

// Reads the signs of one row of node columns, x from `from` up to but not including `to`.
void read_row(const Solid& solid, const std::array<int, 3>& first_node, int y, int from, int to, NodeColumns& columns) {
    const DexelSet& set = solid.sets[2];
    const int v = first_node[1] + y, u_end = first_node[0] + to;
    std::uint32_t* bits = &columns[TileSamples::column(from, y)];
    for (int u = first_node[0] + from; u < u_end;) {
        if (u < 0 || v < 0 || u >= set.rays_u() || v >= set.rays_v()) {  // outside the lattice
            *bits++ = 0;
            ++u;
            continue;
        }
        const DexelSet::Run run = set.run(u, v);
        const int rays = std::min(run.rays, u_end - u);
        for (int i = 0; i < rays; ++i) {
            const std::span<const DexelEnd> ends = run.ends_of(i);
            *bits++ = shared::MeshedRay{ends.data()}.node_bits(static_cast<std::uint32_t>(ends.size()), first_node[2]);
        }
        u += rays;
    }
}

// Returns for each row y, at index y + 1, a word whose bit x + 1 is set when the column of cells (x, y) has dirty
// cells.
std::array<std::uint32_t, kSeenCells> dirty_columns(const CellMask& dirty) {
    std::array<std::uint32_t, kSeenCells> rows;
    const std::uint32_t* column = dirty.columns.data();
    for (std::uint32_t& row : rows) {
        row = 0;
        for (int x = 0; x < kSeenCells; ++x) row |= (*column++ != 0 ? 1u : 0u) << x;
    }
    return rows;
}

// Pads the mask with a border without cells, which gives the cells at and before each node, -2 .. kTileCells.
constexpr std::size_t kPadded = kLocalNodes + 1;
[[gnu::always_inline]] inline std::array<std::uint32_t, kPadded * kPadded> with_border(const CellMask& cells) {
    std::array<std::uint32_t, kPadded * kPadded> padded{};
    for (std::size_t y = 0; y < kSeenCells; ++y) {
        std::copy_n(&cells.columns[y * kSeenCells], kSeenCells, &padded[(y + 1) * kPadded + 1]);
    }
    return padded;
}

}  // namespace

bool TileSamples::collect_signs(const Solid& solid, const std::array<int, 3>& first_node, const NodeColumns* before,
                                const CellMask& dirty) {
    if (before == nullptr) {
        for (int y = -1; y < kLocalNodes - 1; ++y) read_row(solid, first_node, y, -1, kLocalNodes - 1, columns_);
    } else {
        columns_ = *before;
        const std::array<std::uint32_t, kSeenCells> rows = dirty_columns(dirty);
        for (std::size_t row = 0; row < kLocalNodes; ++row) {
            // Reads the node columns from the first to the last one next to a dirty cell.
            const std::uint32_t cells = (row < kSeenCells ? rows[row] : 0u) | (row > 0 ? rows[row - 1] : 0u);
            if (cells == 0) continue;
            read_row(solid, first_node, static_cast<int>(row) - 1, std::countr_zero(cells) - 1,
                     static_cast<int>(std::bit_width(cells)), columns_);
        }
    }
    return find_crossed();
}

bool TileSamples::take_signs(std::span<const std::uint32_t> signs) {
    std::ranges::copy(signs, columns_.begin());
    return find_crossed();
}

bool TileSamples::find_crossed() {
    constexpr std::uint32_t kAllNodes = (1u << kLocalNodes) - 1u;
    std::uint32_t any = 0, all = kAllNodes;
    for (const std::uint32_t bits : columns_) {
        any |= bits;
        all &= bits;
    }
    if (any == 0 || all == kAllNodes) return false;
    constexpr std::size_t kRow = kLocalNodes, kAll = kRow * kRow;
    // The highest local node has no edge upwards: the last column of each row, the last row and the last bit stay 0.
    for (std::size_t row = 0; row < kAll; row += kRow) {
        for (std::size_t i = row; i < row + kRow - 1; ++i) crossed_[0][i] = columns_[i] ^ columns_[i + 1];
    }
    for (std::size_t i = 0; i < kAll - kRow; ++i) crossed_[1][i] = columns_[i] ^ columns_[i + kRow];
    for (std::size_t i = 0; i < kAll; ++i) crossed_[2][i] = shared::crossed_upwards(columns_[i]);
    return true;
}

CellMask TileSamples::cells_at_own_edges() const {
    EdgeMask own{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t row = column(0, 0); row < column(0, kTileCells); row += kLocalNodes) {
            for (std::size_t i = row; i < row + kTileCells; ++i) own[axis][i] = crossed_[axis][i] & shared::kOwnNodes;
        }
    }
    CellMask cells;
    for (std::size_t y = 0; y < kSeenCells; ++y) {
        const std::size_t row = y * kLocalNodes, above = row + kLocalNodes;
        for (std::size_t x = 0; x < kSeenCells; ++x) {
            const std::uint32_t level = own[0][row + x] | own[0][above + x] | own[1][row + x] | own[1][row + x + 1];
            const std::uint32_t upright =
                own[2][row + x] | own[2][row + x + 1] | own[2][above + x] | own[2][above + x + 1];
            cells.columns[y * kSeenCells + x] = shared::cells_beside_edges(level, upright);
        }
    }
    return cells;
}

bool TileSamples::same_signs(const NodeColumns& before, const CellMask& cells) const {
    const auto padded = with_border(cells);
    std::uint32_t changed = 0;
    for (std::size_t y = 0; y < kLocalNodes; ++y) {
        const std::uint32_t *const at = &padded[(y + 1) * kPadded], *const below = at - kPadded;
        const std::size_t row = y * kLocalNodes;
        for (std::size_t x = 0; x < kLocalNodes; ++x) {
            const std::uint32_t around = at[x] | at[x + 1] | below[x] | below[x + 1];
            changed |= (before[row + x] ^ columns_[row + x]) & (around | around << 1);
        }
    }
    return changed == 0;
}

EdgeMask edges_of(const CellMask& cells) {
    const auto padded = with_border(cells);
    EdgeMask edges;
    for (std::size_t y = 0; y < kLocalNodes; ++y) {
        const std::uint32_t *const before = &padded[(y + 1) * kPadded], *const below = before - kPadded;
        const std::size_t row = y * kLocalNodes;
        for (std::size_t x = 0; x < kLocalNodes; ++x) {
            const std::uint32_t along_x = before[x + 1] | below[x + 1], along_y = before[x + 1] | before[x];
            edges[0][row + x] = shared::level_edges_of(along_x);
            edges[1][row + x] = shared::level_edges_of(along_y);
            edges[2][row + x] = along_x | before[x] | below[x];
        }
    }
    return edges;
}

void TileSamples::collect_crossings(const Solid& solid, const std::array<int, 3>& first_node, const CellMask& cells) {
    EdgeMask wanted = edges_of(cells);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < wanted[axis].size(); ++i) wanted[axis][i] &= crossed_[axis][i];
    }
    count_ = 0;
    collect_along<0>(solid, first_node, wanted[0]);
    collect_along<1>(solid, first_node, wanted[1]);
    collect_along<2>(solid, first_node, wanted[2]);
}

template <int axis>
void TileSamples::collect_along(const Solid& solid, const std::array<int, 3>& first_node, const NodeColumns& edges) {
    std::size_t i = 0;
    for (int y = -1; y < kLocalNodes - 1; ++y) {
        for (int x = -1; x < kLocalNodes - 1; x += 2, i += 2) {
            std::uint64_t two = 0;  // two columns at once; usually both are empty
            __builtin_memcpy(&two, &edges[i], sizeof two);
            if (two == 0) continue;
            collect_column<axis>(solid, first_node, x, y, edges[i]);
            collect_column<axis>(solid, first_node, x + 1, y, edges[i + 1]);
        }
    }
}

template <int axis>
[[gnu::always_inline]] inline void TileSamples::collect_column(const Solid& solid, const std::array<int, 3>& first_node,
                                                               int x, int y, std::uint32_t edges) {
    constexpr std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::uint32_t own = x >= 0 && x < kTileCells && y >= 0 && y < kTileCells ? shared::kOwnNodes : 0u;
    const std::uint32_t inside = columns_[column(x, y)];
    const int first_own_edge = ((axis * kTileCells + y) * kTileCells + x) * kTileCells - 1;
    for (std::uint32_t bits = edges; bits != 0; bits &= bits - 1) {
        const int bit = std::countr_zero(bits);
        const Local node{x, y, bit - 1};
        sample_index_[edge_offset(axis, {x + 1, y + 1, bit})] = static_cast<std::uint16_t>(count_);
        EdgeSample& sample = samples_[count_++];
        sample.axis = axis;
        sample.node = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(bit - 1)};
        sample.own_edge =
            (own >> bit & 1u) != 0 ? static_cast<std::uint16_t>(first_own_edge + bit) : EdgeSample::kNotOwn;
        sample.lower_inside = (inside >> bit & 1u) != 0;
        // One of the edge's nodes is inside, so it is in the lattice, and so is the edge's ray.
        const auto ends = solid.sets[axis].ends(first_node[u] + node[u], first_node[v] + node[v]);
        read_crossing(ends, first_node[axis] + node[axis], sample);
    }
}

std::size_t TileSamples::own_crossed(const EdgeMask& edges) const {
    std::size_t count = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t row = column(0, 0); row < column(0, kTileCells); row += kLocalNodes) {
            count += bits_of_row(kTileCells, [&](std::size_t x) {
                return crossed_[axis][row + x] & edges[axis][row + x] & shared::kOwnNodes;
            });
        }
    }
    return count;
}

bool TileSamples::take_crossings(std::span<const shared::MadeEdge> crossings, const EdgeMask& edges) {
    if (crossings.size() != own_crossed(edges)) return false;
    count_ = 0;
    std::uint32_t least = 0;
    for (const shared::MadeEdge& crossing : crossings) {
        const std::uint32_t number = crossing.what & geometry::SurfaceTile::kQuadEdge;
        const std::uint32_t axis = number / kTileCells / kTileCells / kTileCells,
                            y = number / kTileCells / kTileCells % kTileCells, x = number / kTileCells % kTileCells,
                            z = number % kTileCells;
        if (number < least || axis > 2) return false;
        least = number + 1;
        const std::size_t at = column(static_cast<int>(x), static_cast<int>(y));
        const bool lower_inside = (crossing.what >> 16 & 1u) != 0;
        if (((crossed_[axis][at] & edges[axis][at]) >> (z + 1) & 1u) == 0) return false;
        if ((columns_[at] >> (z + 1) & 1u) != (lower_inside ? 1u : 0u)) return false;
        const shared::Direction n = shared::decode_normal(crossing.normal);
        EdgeSample& sample = samples_[count_++];
        sample.normal = {n.x, n.y, n.z};
        sample.own_edge = static_cast<std::uint16_t>(number);
        sample.disagrees = (crossing.what & geometry::SurfaceTile::kDisagrees) != 0;
        sample.lower_inside = lower_inside;
        sample.axis = static_cast<std::uint8_t>(axis);
        sample.node = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z)};
    }
    return true;
}

}  // namespace burin::compute
