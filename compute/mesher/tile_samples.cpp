// SPDX-License-Identifier: MIT
#include "compute/tile_samples.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "shaders/shared/octahedral.h"

namespace burin {
namespace {

using shared::DexelEnd;
using shared::kUnitsPerCell;

constexpr std::uint32_t kOwn = ((1u << kTileCells) - 1u) << 1;

// The lowest node at or above a depth.
int node_at_or_above(int depth) { return (depth + kUnitsPerCell - 1) / kUnitsPerCell; }

// Bits 0 .. kLocalNodes - 1: nodes first - 1 .. of the ray that are inside. A node at depth d is inside when lo <= d < hi.
std::uint32_t node_bits(std::span<const DexelEnd> ends, int first_node) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
        const int from = std::max(node_at_or_above(depth_of(ends[i])) - (first_node - 1), 0);
        const int to = std::min(node_at_or_above(depth_of(ends[i + 1])) - (first_node - 1), kLocalNodes);
        if (from >= kLocalNodes) break;
        if (from < to) bits |= ((1u << to) - 1u) & ~((1u << from) - 1u);
    }
    return bits;
}

// The end that makes the crossing of the edge between nodes `lower` and `lower + 1`. An edge whose lower node is inside is
// left through an upper end (odd index), else entered through a lower end. Nothing when there is none near the edge.
const DexelEnd* crossing_end(std::span<const DexelEnd> ends, int lower, bool lower_inside) {
    const int edge_lo = lower * kUnitsPerCell, edge_hi = edge_lo + kUnitsPerCell;
    const DexelEnd* best = nullptr;
    int best_distance = kNearEdge;
    for (std::size_t i = lower_inside ? 1 : 0; i < ends.size(); i += 2) {
        const int depth = depth_of(ends[i]);
        if (depth >= edge_hi + kNearEdge) break;
        const int distance = depth <= edge_lo ? edge_lo - depth + 1 : std::max(depth - edge_hi, 0);
        // Of several on the edge itself: the first one to leave by, the last one to enter by, the one next to the inside node.
        if (distance < best_distance || (distance == 0 && best_distance == 0 && !lower_inside)) {
            best = &ends[i];
            best_distance = distance;
        }
    }
    return best;
}

// Where the edge from node `lower` of this ray is crossed; the sample knows its axis and which end is inside.
[[gnu::always_inline]] inline void read_crossing(std::span<const DexelEnd> ends, int lower, EdgeSample& sample) {
    std::uint32_t normal_code = 0;
    const DexelEnd* end = crossing_end(ends, lower, sample.lower_inside);
    if (end == nullptr) [[unlikely]] {
        normal_code = shared::axis_normal(sample.axis, sample.lower_inside);
        sample.disagrees = true;
        sample.along = 0.5f;
        sample.material = 0;
    } else {
        const int offset = depth_of(*end) - lower * kUnitsPerCell;
        sample.along = static_cast<float>(std::clamp(offset, 0, kUnitsPerCell)) / static_cast<float>(kUnitsPerCell);
        normal_code = end->normal;
        sample.material = static_cast<std::uint8_t>(material_of(*end));
        sample.disagrees = offset <= 0 || offset > kUnitsPerCell;
    }
    const shared::Direction n = shared::decode_normal(normal_code);
    sample.normal = {n.x, n.y, n.z};
}

// The signs of one row of columns, x from `from` to `to`.
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
        for (int i = 0; i < rays; ++i) *bits++ = node_bits(run.ends_of(i), first_node[2]);
        u += rays;
    }
}

// A bit x + 1 for each column of cells in row y that is dirty; row y + 1 of the result.
std::array<std::uint32_t, kSeenCells> dirty_columns(const CellMask& dirty) {
    std::array<std::uint32_t, kSeenCells> rows;
    const std::uint32_t* column = dirty.columns.data();
    for (std::uint32_t& row : rows) {
        row = 0;
        for (int x = 0; x < kSeenCells; ++x) row |= (*column++ != 0 ? 1u : 0u) << x;
    }
    return rows;
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
            // The columns of nodes from the first to the last one beside dirty cells.
            const std::uint32_t cells = (row < kSeenCells ? rows[row] : 0u) | (row > 0 ? rows[row - 1] : 0u);
            if (cells == 0) continue;
            read_row(solid, first_node, static_cast<int>(row) - 1, std::countr_zero(cells) - 1,
                     static_cast<int>(std::bit_width(cells)), columns_);
        }
    }
    constexpr std::uint32_t kAll = (1u << kLocalNodes) - 1u;
    std::uint32_t any = 0, all = kAll;
    for (const std::uint32_t bits : columns_) {
        any |= bits;
        all &= bits;
    }
    if (any == 0 || all == kAll) return false;
    find_crossed();
    return true;
}

void TileSamples::find_crossed() {
    constexpr std::size_t kRow = kLocalNodes, kAll = kRow * kRow;
    // The highest local node has no edge upwards: the last column of each row, the last row and the last bit stay 0.
    for (std::size_t row = 0; row < kAll; row += kRow) {
        for (std::size_t i = row; i < row + kRow - 1; ++i) crossed_[0][i] = columns_[i] ^ columns_[i + 1];
    }
    for (std::size_t i = 0; i < kAll - kRow; ++i) crossed_[1][i] = columns_[i] ^ columns_[i + kRow];
    constexpr std::uint32_t kLower = (1u << (kLocalNodes - 1)) - 1u;
    for (std::size_t i = 0; i < kAll; ++i) crossed_[2][i] = (columns_[i] ^ (columns_[i] >> 1)) & kLower;
}

CellMask TileSamples::cells_at_own_edges() const {
    EdgeMask own{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t row = column(0, 0); row < column(0, kTileCells); row += kLocalNodes) {
            for (std::size_t i = row; i < row + kTileCells; ++i) own[axis][i] = crossed_[axis][i] & kOwn;
        }
    }
    CellMask cells;
    for (std::size_t y = 0; y < kSeenCells; ++y) {
        const std::size_t row = y * kLocalNodes, above = row + kLocalNodes;
        for (std::size_t x = 0; x < kSeenCells; ++x) {
            // An edge along x or y touches the cells on both sides of its node's height, z and z - 1.
            const std::uint32_t level = own[0][row + x] | own[0][above + x] | own[1][row + x] | own[1][row + x + 1];
            const std::uint32_t upright =
                own[2][row + x] | own[2][row + x + 1] | own[2][above + x] | own[2][above + x + 1];
            cells.columns[y * kSeenCells + x] = level | level >> 1 | upright;
        }
    }
    return cells;
}

EdgeMask edges_of(const CellMask& cells) {
    // With a border of no cells: the cells at and before each node, -2 .. kTileCells.
    constexpr std::size_t kPadded = kLocalNodes + 1;
    std::array<std::uint32_t, kPadded * kPadded> padded{};
    for (std::size_t y = 0; y < kSeenCells; ++y) {
        std::copy_n(&cells.columns[y * kSeenCells], kSeenCells, &padded[(y + 1) * kPadded + 1]);
    }
    EdgeMask edges;
    for (std::size_t y = 0; y < kLocalNodes; ++y) {
        const std::uint32_t *const before = &padded[(y + 1) * kPadded], *const below = before - kPadded;
        const std::size_t row = y * kLocalNodes;
        for (std::size_t x = 0; x < kLocalNodes; ++x) {
            const std::uint32_t along_x = before[x + 1] | below[x + 1], along_y = before[x + 1] | before[x];
            edges[0][row + x] = along_x | along_x << 1;
            edges[1][row + x] = along_y | along_y << 1;
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
            std::uint64_t two = 0;  // mostly no edges
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
    const std::uint32_t own = x >= 0 && x < kTileCells && y >= 0 && y < kTileCells ? kOwn : 0u;
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

}  // namespace burin
