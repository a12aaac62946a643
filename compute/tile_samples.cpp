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
    if (u < 0 || v < 0 || u >= solid.lattice.rays_u(axis) || v >= solid.lattice.rays_v(axis)) return {};
    const auto index = static_cast<std::size_t>(v) * static_cast<std::size_t>(solid.lattice.rays_u(axis)) +
                       static_cast<std::size_t>(u);
    return solid.sets[static_cast<std::size_t>(axis)].ends(index);
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
// left through an upper end (odd index), else entered through a lower end. Nothing when there is none within one cell.
const DexelEnd* crossing_end(std::span<const DexelEnd> ends, int lower, bool lower_inside) {
    const int edge_lo = lower * kUnitsPerCell, edge_hi = edge_lo + kUnitsPerCell;
    const DexelEnd* best = nullptr;
    int best_distance = kUnitsPerCell;
    for (std::size_t i = lower_inside ? 1 : 0; i < ends.size(); i += 2) {
        const int depth = depth_of(ends[i]);
        if (depth > edge_hi + kUnitsPerCell) break;
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
    const DexelEnd* end = crossing_end(ends, lower, lower_inside);
    if (end == nullptr) {
        shared::IntVector n{0, 0, 0};
        (axis == 0 ? n.x : axis == 1 ? n.y : n.z) = lower_inside ? 1 : -1;
        sample.normal_code = shared::encode_normal(n);
        sample.disagrees = true;
    } else {
        const int offset = depth_of(*end) - lower * kUnitsPerCell;
        sample.along = static_cast<float>(std::clamp(offset, 0, kUnitsPerCell)) / static_cast<float>(kUnitsPerCell);
        sample.normal_code = end->normal;
        sample.material = static_cast<std::uint8_t>(material_of(*end));
        sample.disagrees = offset <= 0 || offset > kUnitsPerCell;
    }
    const shared::Direction n = shared::decode_normal(sample.normal_code);
    sample.normal = {n.x, n.y, n.z};
    return sample;
}

}  // namespace

bool TileSamples::collect(const Solid& solid, const std::array<int, 3>& first_node) {
    if (!collect_signs(solid, first_node)) return false;
    collect_crossings(solid, first_node);
    return true;
}

bool TileSamples::collect_signs(const Solid& solid, const std::array<int, 3>& first_node) {
    constexpr std::uint32_t kAll = (1u << kLocalNodes) - 1u;
    std::uint32_t any = 0, all = kAll;
    for (int y = -1; y < kLocalNodes - 1; ++y) {
        for (int x = -1; x < kLocalNodes - 1; ++x) {
            const std::uint32_t bits =
                node_bits(ray_ends(solid, 2, first_node[0] + x, first_node[1] + y), first_node[2]);
            columns_[static_cast<std::size_t>((y + 1) * kLocalNodes + x + 1)] = bits;
            any |= bits;
            all &= bits;
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

void TileSamples::collect_crossings(const Solid& solid, const std::array<int, 3>& first_node) {
    samples_.clear();
    for (int axis = 0; axis < 3; ++axis) {
        for (int y = -1; y < kLocalNodes - 1; ++y) {
            for (int x = -1; x < kLocalNodes - 1; ++x) {
                for (std::uint32_t bits = crossed(axis, x, y); bits != 0; bits &= bits - 1) {
                    const Local node{x, y, std::countr_zero(bits) - 1};
                    const auto s = static_cast<std::size_t>(axis), u = (s + 1) % 3, v = (s + 2) % 3;
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
