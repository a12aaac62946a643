// SPDX-License-Identifier: MIT
#include "compute/dirty_cells.hpp"

#include <algorithm>
#include <bit>

#include "compute/tile_samples.hpp"

namespace burin {
namespace {

// Cells of one tile, counted from its first node.
void mark_cells(const std::array<int, 3>& lo, const std::array<int, 3>& hi, CellMask& mask) {
    const std::uint32_t bits = (2u << (hi[2] + 1)) - (1u << (lo[2] + 1));
    std::uint32_t* row = &mask.columns[CellMask::column(lo[0], lo[1])];
    const int width = hi[0] - lo[0] + 1;
    if (width == 2) {  // beside a ray along y or z
        for (int y = lo[1]; y <= hi[1]; ++y, row += kSeenCells) {
            row[0] |= bits;
            row[1] |= bits;
        }
        return;
    }
    for (int y = lo[1]; y <= hi[1]; ++y, row += kSeenCells)
        for (int x = 0; x < width; ++x) row[x] |= bits;
}

}  // namespace

DirtyCells::CellRange DirtyCells::range_of(const shared::ChangedRay& change) {
    const RayPlace place = place_of(change.ray);
    const auto cell = [](int depth) { return ((depth + shared::kUnitsPerCell) >> shared::kSubcellBits) - 1; };
    const int s_lo = cell(change.changed_lo - kNearEdge), s_hi = cell(change.changed_hi + kNearEdge);
    const int u = place.u, v = place.v;
    if (place.axis == 0) return {{s_lo, u - 1, v - 1}, {s_hi, u, v}};
    if (place.axis == 1) return {{v - 1, s_lo, u - 1}, {v, s_hi, u}};
    return {{u - 1, v - 1, s_lo}, {u, v, s_hi}};
}

CellMask& DirtyCells::Share::mask_of(std::uint32_t tile) {
    if (slot[tile] == kNone) {
        slot[tile] = static_cast<std::uint32_t>(tiles.size());
        if (tiles.size() == masks.size()) masks.emplace_back();
        masks[tiles.size()].columns.fill(0);
        tiles.push_back(tile);
    }
    return masks[slot[tile]];
}

void DirtyCells::mark(std::span<const shared::ChangedRay> changes, Share& share) const {
    share.slot.resize(grid_.count(), kNone);
    for (const std::uint32_t tile : share.tiles) share.slot[tile] = kNone;
    share.tiles.clear();
    const std::array<int, 3> cells = lattice_.cells;
    constexpr int kTileBits = std::countr_zero(static_cast<unsigned>(kTileCells));
    for (const shared::ChangedRay& change : changes) {
        CellRange range = range_of(change);
        // From the tile that has the lowest cell to the one that sees the highest from above.
        std::array<int, 3> from{}, to{};
        bool one_tile = true;
        for (std::size_t a = 0; a < 3; ++a) {
            from[a] = std::clamp(range.lo[a], 0, cells[a]) >> kTileBits;
            to[a] = std::clamp(range.hi[a] + 1, 0, cells[a]) >> kTileBits;
            one_tile &= from[a] == to[a];
        }
        if (one_tile) {  // most; and then every cell is one that the tile sees
            for (std::size_t a = 0; a < 3; ++a) {
                range.lo[a] -= from[a] << kTileBits;
                range.hi[a] -= from[a] << kTileBits;
            }
            mark_cells(range.lo, range.hi, share.mask_of(grid_.index(from[0], from[1], from[2])));
            continue;
        }
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x) {
                    const std::array<int, 3> first{x << kTileBits, y << kTileBits, z << kTileBits};
                    std::array<int, 3> lo{}, hi{};
                    for (std::size_t a = 0; a < 3; ++a) {
                        lo[a] = std::max(range.lo[a] - first[a], -1);
                        hi[a] = std::min(range.hi[a] - first[a], kTileCells - 1);
                    }
                    if (lo[2] <= hi[2]) mark_cells(lo, hi, share.mask_of(grid_.index(x, y, z)));
                }
    }
}

void DirtyCells::sort(const Changes& changes, WorkerPool& pool) {
    constexpr std::size_t kLeastChanges = 400;  // fewer are marked sooner than a thread is woken
    const std::size_t count =
        std::clamp<std::size_t>(changes.rays.size() / kLeastChanges, 1, std::max<std::size_t>(1, pool.threads()));
    shares_.resize(std::max(shares_.size(), count));
    const std::size_t each = (changes.rays.size() + count - 1) / count;
    const std::span<const shared::ChangedRay> all(changes.rays);
    pool.run(count, [&](std::size_t i) {
        const std::size_t from = std::min(i * each, all.size());
        mark(all.subspan(from, std::min(each, all.size() - from)), shares_[i]);
    });
    // Those that are not needed now are emptied: they are read all the same.
    for (std::size_t i = count; i < shares_.size(); ++i) mark({}, shares_[i]);
    tiles_.clear();
    for (const Share& share : shares_) tiles_.insert(tiles_.end(), share.tiles.begin(), share.tiles.end());
    std::ranges::sort(tiles_);
    tiles_.erase(std::ranges::unique(tiles_).begin(), tiles_.end());
}

CellMask DirtyCells::mask(std::uint32_t tile) const {
    CellMask mask;
    for (const Share& share : shares_) {
        if (share.slot[tile] == kNone) continue;
        const CellMask& marked = share.masks[share.slot[tile]];
        for (std::size_t i = 0; i < mask.columns.size(); ++i) mask.columns[i] |= marked.columns[i];
    }
    return mask;
}

}  // namespace burin
