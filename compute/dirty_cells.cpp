// SPDX-License-Identifier: MIT
#include "compute/dirty_cells.hpp"

#include <algorithm>

#include "compute/tile_samples.hpp"

namespace burin {

// The cells of the lattice around a change; -1 is the empty layer below the first.
DirtyCells::CellRange DirtyCells::range_of(const shared::ChangedRay& change) const {
    const RayPlace place = place_of(change.ray);
    const auto s = static_cast<std::size_t>(place.axis), u = (s + 1) % 3, v = (s + 2) % 3;
    const auto cell = [](int depth) { return ((depth + shared::kUnitsPerCell) >> shared::kSubcellBits) - 1; };
    CellRange range{};
    range.lo[s] = cell(change.changed_lo - kNearEdge);
    range.hi[s] = cell(change.changed_hi + kNearEdge);
    range.lo[u] = place.u - 1;
    range.hi[u] = place.u;
    range.lo[v] = place.v - 1;
    range.hi[v] = place.v;
    return range;
}

void DirtyCells::sort(const Changes& changes) {
    for (const std::uint32_t tile : tiles_) newest_[tile] = kNone;
    tiles_.clear();
    entries_.clear();
    changes_ = changes.rays;
    for (std::uint32_t i = 0; i < changes_.size(); ++i) {
        const CellRange range = range_of(changes_[i]);
        std::array<int, 3> from{}, to{};
        for (std::size_t a = 0; a < 3; ++a) {
            from[a] = std::clamp(range.lo[a], 0, lattice_.cells[a]) / kTileCells;
            to[a] = std::clamp(range.hi[a] + 1, 0, lattice_.cells[a]) / kTileCells;  // also seen from above
        }
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x) {
                    const std::uint32_t tile = grid_.index(x, y, z);
                    if (newest_[tile] == kNone) tiles_.push_back(tile);
                    entries_.push_back({i, newest_[tile]});
                    newest_[tile] = static_cast<std::uint32_t>(entries_.size() - 1);
                }
    }
    std::ranges::sort(tiles_);
}

CellMask DirtyCells::mask(std::uint32_t tile) const {
    CellMask mask;
    const std::array<int, 3> first = grid_.first_node(tile);
    for (std::uint32_t e = newest_[tile]; e != kNone; e = entries_[e].before) {
        const CellRange range = range_of(changes_[entries_[e].change]);
        std::array<int, 3> lo{}, hi{};
        for (std::size_t a = 0; a < 3; ++a) {
            lo[a] = std::max(range.lo[a] - first[a], -1);
            hi[a] = std::min(range.hi[a] - first[a], kTileCells - 1);
        }
        if (lo[2] > hi[2]) continue;
        const std::uint32_t bits = ((1u << (hi[2] + 2)) - 1u) & ~((1u << (lo[2] + 1)) - 1u);
        for (int y = lo[1]; y <= hi[1]; ++y)
            for (int x = lo[0]; x <= hi[0]; ++x) mask.add(x, y, bits);
    }
    return mask;
}

}  // namespace burin
