// SPDX-License-Identifier: MIT
#include "compute/dirty_cells.hpp"

#include <algorithm>
#include <bit>

#include "compute/tile_samples.hpp"

namespace burin {

DirtyCells::CellRange DirtyCells::range_of(const shared::ChangedRay& change) {
    const RayPlace place = place_of(change.ray);
    const auto cell = [](int depth) {
        return static_cast<std::int16_t>(((depth + shared::kUnitsPerCell) >> shared::kSubcellBits) - 1);
    };
    const std::int16_t s_lo = cell(change.changed_lo - kNearEdge), s_hi = cell(change.changed_hi + kNearEdge);
    const auto u = static_cast<std::int16_t>(place.u), v = static_cast<std::int16_t>(place.v);
    const auto below = [](std::int16_t a) { return static_cast<std::int16_t>(a - 1); };
    if (place.axis == 0) return {{s_lo, below(u), below(v)}, {s_hi, u, v}};
    if (place.axis == 1) return {{below(v), s_lo, below(u)}, {v, s_hi, u}};
    return {{below(u), below(v), s_lo}, {u, v, s_hi}};
}

void DirtyCells::sort(const Changes& changes) {
    for (const std::uint32_t tile : tiles_) newest_[tile] = kNone;
    tiles_.clear();
    entries_.clear();
    const std::array<int, 3> cells = lattice_.cells;
    constexpr int kTileBits = std::countr_zero(static_cast<unsigned>(kTileCells));
    for (const shared::ChangedRay& change : changes.rays) {
        const CellRange range = range_of(change);
        std::array<int, 3> from{}, to{};
        for (std::size_t a = 0; a < 3; ++a) {
            from[a] = std::clamp<int>(range.lo[a], 0, cells[a]) >> kTileBits;
            to[a] = std::clamp<int>(range.hi[a] + 1, 0, cells[a]) >> kTileBits;  // also seen from above
        }
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x) {
                    const std::uint32_t tile = grid_.index(x, y, z);
                    if (newest_[tile] == kNone) tiles_.push_back(tile);
                    entries_.push_back({range, newest_[tile]});
                    newest_[tile] = static_cast<std::uint32_t>(entries_.size() - 1);
                }
    }
    std::ranges::sort(tiles_);
}

CellMask DirtyCells::mask(std::uint32_t tile) const {
    CellMask mask;
    const std::array<int, 3> first = grid_.first_node(tile);
    for (std::uint32_t e = newest_[tile]; e != kNone; e = entries_[e].before) {
        const CellRange& range = entries_[e].range;
        std::array<int, 3> lo{}, hi{};
        for (std::size_t a = 0; a < 3; ++a) {
            lo[a] = std::max(range.lo[a] - first[a], -1);
            hi[a] = std::min(range.hi[a] - first[a], kTileCells - 1);
        }
        if (lo[2] > hi[2]) continue;
        const std::uint32_t bits = (2u << (hi[2] + 1)) - (1u << (lo[2] + 1));
        for (int y = lo[1]; y <= hi[1]; ++y)
            for (int x = lo[0]; x <= hi[0]; ++x) mask.add(x, y, bits);
    }
    return mask;
}

}  // namespace burin
