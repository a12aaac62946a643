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

std::span<const DexelEnd> ray_ends(const Solid& solid, int axis, int u, int v) {
    const DexelSet& set = solid.sets[static_cast<std::size_t>(axis)];
    if (u < 0 || v < 0 || u >= set.rays_u() || v >= set.rays_v()) return {};
    return set.ends(u, v);
}

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

EdgeSample make_sample(std::span<const DexelEnd> ends, int axis, int lower, bool lower_inside) {
    EdgeSample sample;
    std::uint32_t normal_code = 0;
    const DexelEnd* end = crossing_end(ends, lower, lower_inside);
    if (end == nullptr) {
        normal_code = shared::axis_normal(axis, lower_inside);
        sample.disagrees = true;
    } else {
        const int offset = depth_of(*end) - lower * kUnitsPerCell;
        sample.along = static_cast<float>(std::clamp(offset, 0, kUnitsPerCell)) / static_cast<float>(kUnitsPerCell);
        normal_code = end->normal;
        sample.material = static_cast<std::uint8_t>(material_of(*end));
        sample.disagrees = offset <= 0 || offset > kUnitsPerCell;
    }
    const shared::Direction n = shared::decode_normal(normal_code);
    sample.normal = {n.x, n.y, n.z};
    return sample;
}

}  // namespace

bool TileSamples::collect_signs(const Solid& solid, const std::array<int, 3>& first_node) {
    constexpr std::uint32_t kAll = (1u << kLocalNodes) - 1u;
    const DexelSet& set = solid.sets[2];
    std::uint32_t any = 0, all = kAll;
    std::uint32_t* column = columns_.data();
    for (int v = first_node[1] - 1; v < first_node[1] - 1 + kLocalNodes; ++v) {
        const int u_end = first_node[0] - 1 + kLocalNodes;
        for (int u = first_node[0] - 1; u < u_end;) {
            if (u < 0 || v < 0 || u >= set.rays_u() || v >= set.rays_v()) {  // outside the lattice
                *column++ = 0;
                all = 0;
                ++u;
                continue;
            }
            const DexelSet::Run run = set.run(u, v);
            const int rays = std::min(run.rays, u_end - u);
            for (int i = 0; i < rays; ++i) {
                const std::uint32_t bits = node_bits(run.ends_of(i), first_node[2]);
                any |= bits;
                all &= bits;
                *column++ = bits;
            }
            u += rays;
        }
    }
    return any != 0 && all != kAll;
}

std::uint32_t TileSamples::crossed(int axis, int x, int y) const {
    constexpr int kLast = kLocalNodes - 2;  // the highest local node has no edge upwards
    if (axis == 0) return x < kLast ? column(x, y) ^ column(x + 1, y) : 0;
    if (axis == 1) return y < kLast ? column(x, y) ^ column(x, y + 1) : 0;
    return (column(x, y) ^ (column(x, y) >> 1)) & ((1u << (kLocalNodes - 1)) - 1u);
}

CellMask TileSamples::cells_at_own_edges() const {
    CellMask cells;
    for (int y = 0; y < kTileCells; ++y) {
        for (int x = 0; x < kTileCells; ++x) {
            // An edge along x or y touches the cells on both sides of its node's height, z and z - 1.
            const std::uint32_t along_x = own_crossed(0, x, y), along_y = own_crossed(1, x, y),
                                along_z = own_crossed(2, x, y);
            const std::uint32_t both_x = along_x | along_x >> 1, both_y = along_y | along_y >> 1;
            cells.add(x, y, both_x | both_y | along_z);
            cells.add(x, y - 1, both_x | along_z);
            cells.add(x - 1, y, both_y | along_z);
            cells.add(x - 1, y - 1, along_z);
        }
    }
    return cells;
}

void TileSamples::collect_crossings(const Solid& solid, const std::array<int, 3>& first_node, const CellMask& cells) {
    samples_.clear();
    const auto cell_bits = [&](int x, int y) {
        return x < kTileCells && y < kTileCells && x >= -1 && y >= -1 ? cells.at(x, y) : 0u;
    };
    for (int y = -1; y < kLocalNodes - 1; ++y) {
        for (int x = -1; x < kLocalNodes - 1; ++x) {
            const std::uint32_t here = cell_bits(x, y), left = cell_bits(x - 1, y), below = cell_bits(x, y - 1),
                                across = cell_bits(x - 1, y - 1);
            if ((here | left | below | across) == 0) continue;
            const auto both = [](std::uint32_t c) { return c | c << 1; };
            const std::array<std::uint32_t, 3> wanted{both(here | below), both(here | left),
                                                      here | left | below | across};
            for (int axis = 0; axis < 3; ++axis) {
                const auto s = static_cast<std::size_t>(axis), u = (s + 1) % 3, v = (s + 2) % 3;
                for (std::uint32_t bits = crossed(axis, x, y) & wanted[s]; bits != 0; bits &= bits - 1) {
                    const Local node{x, y, std::countr_zero(bits) - 1};
                    const auto ends = ray_ends(solid, axis, first_node[u] + node[u], first_node[v] + node[v]);
                    sample_index_[s][node_index(node)] = static_cast<std::uint16_t>(samples_.size());
                    samples_.push_back(make_sample(ends, axis, first_node[s] + node[s], inside(node)));
                }
            }
        }
    }
}

unsigned TileSamples::cell_pattern(const Local& cell) const {
    const int shift = cell[2] + 1;
    const auto pair = [&](int dx, int dy) { return column(cell[0] + dx, cell[1] + dy) >> shift & 3u; };
    const std::uint32_t p00 = pair(0, 0), p10 = pair(1, 0), p01 = pair(0, 1), p11 = pair(1, 1);
    return (p00 & 1u) | (p10 & 1u) << 1 | (p01 & 1u) << 2 | (p11 & 1u) << 3 |  //
           (p00 >> 1) << 4 | (p10 >> 1) << 5 | (p01 >> 1) << 6 | (p11 >> 1) << 7;
}

}  // namespace burin
