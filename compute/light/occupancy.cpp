// SPDX-License-Identifier: MIT
#include "compute/light/occupancy.hpp"

#include <algorithm>
#include <bit>

namespace burin::compute {
namespace {

using shared::DexelEnd;

// A node at depth d is inside when lo <= d < hi (shaders/shared/dexel.h); nodes outside the lattice are not.
bool node_inside(const Solid& solid, const std::array<int, 3>& node) {
    if (node[0] > solid.lattice.cells[0] || node[1] > solid.lattice.cells[1]) return false;
    const std::span<const DexelEnd> ends = solid.sets[2].ends(node[0], node[1]);
    const int depth = node[2] * shared::kUnitsPerCell;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        if (depth_of(ends[i]) <= depth && depth < depth_of(ends[i + 1])) return true;
    }
    return false;
}

}  // namespace

NodeBox NodeBox::grown(int nodes) const {
    NodeBox box = *this;
    for (std::size_t a = 0; a < 3; ++a) {
        box.lo[a] -= nodes;
        box.hi[a] += nodes;
    }
    return box;
}

void NodeBox::include(const NodeBox& other) {
    for (std::size_t a = 0; a < 3; ++a) {
        lo[a] = std::min(lo[a], other.lo[a]);
        hi[a] = std::max(hi[a], other.hi[a]);
    }
}

std::optional<NodeBox> Occupancy::update(std::uint32_t tile, const Solid& solid, const TileMesh* mesh) {
    const std::array<int, 3> first = grid_.first_node(tile);
    // No edge that starts at a node of a tile without mesh is crossed, so all of its nodes have the sign of the first
    // one.
    const std::uint32_t uniform = mesh == nullptr && node_inside(solid, first) ? kFullColumn : 0u;
    Columns fresh;
    std::uint32_t any = 0, all = kFullColumn, changed_z = 0;
    NodeBox changed{{kTileCells, kTileCells, 0}, {-1, -1, 0}};
    for (int y = 0; y < kTileCells; ++y)
        for (int x = 0; x < kTileCells; ++x) {
            const std::uint32_t bits =
                mesh == nullptr ? uniform : mesh->signs[TileSamples::column(x, y)] >> 1 & kFullColumn;
            fresh[static_cast<std::size_t>(y * kTileCells + x)] = static_cast<std::uint16_t>(bits);
            any |= bits;
            all &= bits;
            const std::uint32_t differs = bits ^ column(tile, x, y);
            if (differs == 0) continue;
            changed_z |= differs;
            changed.include({{x, y, 0}, {x, y, 0}});
        }
    if (changed_z == 0) return std::nullopt;
    states_[tile] = any == 0 ? Tile::empty : all == kFullColumn ? Tile::full : Tile::mixed;
    columns_[tile] = states_[tile] == Tile::mixed ? std::make_unique<Columns>(fresh) : nullptr;
    changed.lo[2] = std::countr_zero(changed_z);
    changed.hi[2] = static_cast<int>(std::bit_width(changed_z)) - 1;
    for (std::size_t a = 0; a < 3; ++a) {
        changed.lo[a] += first[a];
        changed.hi[a] += first[a];
    }
    return changed;
}

bool Occupancy::inside(const std::array<int, 3>& node) const {
    for (std::size_t a = 0; a < 3; ++a) {
        if (node[a] < 0 || node[a] >= grid_.tiles[a] * kTileCells) return false;
    }
    const std::uint32_t tile = grid_.index(node[0] / kTileCells, node[1] / kTileCells, node[2] / kTileCells);
    return (column(tile, node[0] % kTileCells, node[1] % kTileCells) >> (node[2] % kTileCells) & 1u) != 0;
}

std::size_t Occupancy::bytes() const {
    const auto mixed = std::ranges::count(states_, Tile::mixed);
    return states_.size() * (sizeof(Tile) + sizeof(void*)) + static_cast<std::size_t>(mixed) * sizeof(Columns);
}

}  // namespace burin::compute
