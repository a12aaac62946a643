// SPDX-License-Identifier: MIT
#include "compute/mesher/dirty_cells.hpp"

#include <algorithm>
#include <bit>

#include "shaders/shared/mesh_tile.h"

namespace burin::compute {
namespace {

// Marks the cells of a range, given in local coordinates of one tile.
void mark_cells(const shared::CellRange& range, CellMask& mask) {
    const auto& [lo, hi] = range;
    const std::uint32_t bits = shared::cells_between(lo[2], hi[2]);
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
        shared::CellRange range = shared::cells_changed(shared::axis_of(change.ray), shared::u_of(change.ray),
                                                        shared::v_of(change.ray), change.changed_lo, change.changed_hi);
        // The affected tiles reach from the one with the lowest cell to the one that sees the highest cell from above.
        std::array<int, 3> from{}, to{};
        bool one_tile = true;
        for (std::size_t a = 0; a < 3; ++a) {
            from[a] = std::clamp(range.lo[a], 0, cells[a]) >> kTileBits;
            to[a] = std::clamp(range.hi[a] + 1, 0, cells[a]) >> kTileBits;
            one_tile &= from[a] == to[a];
        }
        if (one_tile) {  // the usual case; the tile sees all cells of the range
            for (std::size_t a = 0; a < 3; ++a) {
                range.lo[a] -= from[a] << kTileBits;
                range.hi[a] -= from[a] << kTileBits;
            }
            mark_cells(range, share.mask_of(grid_.index(from[0], from[1], from[2])));
            continue;
        }
        for (int z = from[2]; z <= to[2]; ++z)
            for (int y = from[1]; y <= to[1]; ++y)
                for (int x = from[0]; x <= to[0]; ++x) {
                    const shared::CellRange in_tile = shared::cells_seen(range, x, y, z);
                    if (in_tile.lo[2] <= in_tile.hi[2]) mark_cells(in_tile, share.mask_of(grid_.index(x, y, z)));
                }
    }
}

void DirtyCells::sort(const Changes& changes, WorkerPool& pool) {
    constexpr std::size_t kLeastChanges = 400;  // marking fewer takes less time than waking a thread
    const std::size_t count =
        std::clamp<std::size_t>(changes.rays.size() / kLeastChanges, 1, std::max<std::size_t>(1, pool.threads()));
    shares_.resize(std::max(shares_.size(), count));
    const std::size_t each = (changes.rays.size() + count - 1) / count;
    const std::span<const shared::ChangedRay> all(changes.rays);
    pool.run(count, [&](std::size_t i) {
        const std::size_t from = std::min(i * each, all.size());
        mark(all.subspan(from, std::min(each, all.size() - from)), shares_[i]);
    });
    // Clears the unused shares, because mask() reads all of them.
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

}  // namespace burin::compute
