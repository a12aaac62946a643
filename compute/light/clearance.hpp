// SPDX-License-Identifier: MIT
// The distance field that light is baked from: the distance from each lattice node to the nearest node inside the
// solid, up to kReach cells, and 0 inside; blurred over one node on each side, and trilinear between nodes.
//
// Purpose: cones that step through empty space and must know how closely they pass an edge (tile_light.hpp). They rely
// on one property: near a convex body the value at a point is never less than the point's height above any plane that
// the body lies below. Nodes inside lie below the plane, so a node's distance to them is at least its own height, and a
// trilinear mean of values above a linear function is above it too. (The codes are rounded up to preserve this.)
//
// Memory: 4.8 KiB for each tile within reach of the surface, 17 bytes for any other.
// Threads: at() may be called from any number of threads at once, while nobody calls mark or refresh.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/light/occupancy.hpp"

namespace burin::compute {

class Clearance {
public:
    // Cells. A window of 16 + 1 + 2 * (6 + kBlur) nodes fits the bits of a word.
    static constexpr int kReach = 6;
    static constexpr int kBlur = 1;      // nodes
    static constexpr int kPerCell = 42;  // codes per cell: kReach takes 252 of 255

    explicit Clearance(const Lattice& lattice);

    // Notes that these nodes have changed: the next refresh recomputes what lies within reach of them.
    void mark(const NodeBox& changed);
    void mark_all() { stale_.assign(stale_.size(), true); }
    // Recomputes the tiles marked since the last call; returns how many there were.
    std::size_t refresh(const Occupancy& occupancy, WorkerPool& pool);

    // Returns the clearance in cells, from 0 to kReach. `place` is in cells from the lattice's origin, at least 0
    // and below tiles * 16 along each axis.
    [[nodiscard]] float at(const Vec3f& place) const {
        const int x = static_cast<int>(place.x), y = static_cast<int>(place.y), z = static_cast<int>(place.z);
        const std::size_t tile =
            static_cast<std::size_t>(x >> 4) +
            tiles_x_ * (static_cast<std::size_t>(y >> 4) + tiles_y_ * static_cast<std::size_t>(z >> 4));
        const std::uint8_t* const node = codes_[tile] + ((x & 15) * kSide + (y & 15)) * kSide + (z & 15);
        const float fx = place.x - static_cast<float>(x), fy = place.y - static_cast<float>(y),
                    fz = place.z - static_cast<float>(z);
        const auto along_z = [&](std::ptrdiff_t offset) {
            const float low = static_cast<float>(node[offset]), high = static_cast<float>(node[offset + 1]);
            return low + fz * (high - low);
        };
        const float c00 = along_z(0), c01 = along_z(kSide), c10 = along_z(kSide * kSide),
                    c11 = along_z(kSide * kSide + kSide);
        const float c0 = c00 + fy * (c01 - c00), c1 = c10 + fy * (c11 - c10);
        return (c0 + fx * (c1 - c0)) * (1.0f / kPerCell);
    }
    [[nodiscard]] std::size_t bytes() const;

private:
    static_assert(kTileCells == 16);
    // Includes the next tile's first nodes, so that at() reads one tile only.
    static constexpr int kSide = kTileCells + 1;
    using Codes = std::array<std::uint8_t, kSide * kSide * kSide>;  // (x * kSide + y) * kSide + z

    void work_out(const Occupancy& occupancy, std::uint32_t tile);

    TileGrid grid_;
    std::size_t tiles_x_, tiles_y_;
    // For each tile: its own codes, or one of two shared arrays (all far, all inside).
    std::vector<const std::uint8_t*> codes_;
    std::vector<std::unique_ptr<Codes>> held_;  // codes of the tiles that have their own
    std::vector<std::uint8_t> stale_;
    std::vector<std::uint32_t> to_do_;
};

}  // namespace burin::compute
