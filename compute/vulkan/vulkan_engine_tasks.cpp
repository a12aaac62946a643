// SPDX-License-Identifier: MIT
#include "compute/vulkan/vulkan_engine_tasks.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace burin::compute {
namespace {

using shared::Capsule;
using shared::CutTask;

constexpr int kTileRays = 8;                    // 8 x 8 = shared::kCutGroup
constexpr std::size_t kLongestOrder = 4 << 20;  // entries; bounds the memory of the lists
// Relative costs of a ray: to cut it by a capsule, and to find that a capsule is far away.
constexpr std::uint64_t kCutCost = 16, kLookCost = 1;

std::vector<Footprint> footprints(const Lattice& lattice, std::span<const Capsule> capsules, int axis) {
    std::vector<Footprint> all(capsules.size());
    for (std::size_t i = 0; i < capsules.size(); ++i) all[i] = footprint(lattice, capsules[i], axis);
    return all;
}

// Returns the smallest rectangle around all footprints that are not empty.
Footprint rectangle_around(std::span<const Footprint> footprints) {
    Footprint all{1, 0, 1, 0};
    for (const Footprint& f : footprints) {
        if (f.empty()) continue;
        all = all.empty() ? f
                          : Footprint{std::min(all.u_lo, f.u_lo), std::max(all.u_hi, f.u_hi),
                                      std::min(all.v_lo, f.v_lo), std::max(all.v_hi, f.v_hi)};
    }
    return all;
}

// Adds the rays of a rectangle, in strips of no more groups than that.
void add_rectangle(int axis, const Footprint& f, std::uint32_t first, std::uint32_t end, int most_groups,
                   std::vector<CutTask>& tasks) {
    const int width = f.u_hi - f.u_lo + 1, rows = std::max(1, most_groups * shared::kCutGroup / width);
    for (int v = f.v_lo; v <= f.v_hi; v += rows)
        tasks.push_back({axis, f.u_lo, v, width, std::min(rows, f.v_hi - v + 1), first, end, 0});
}

// Sorts the capsules by the tiles of a rectangle that they lie above.
class Tiles {
public:
    Tiles(const Footprint& rectangle, std::span<const Footprint> footprints)
        : footprints_(footprints),
          u0_(rectangle.u_lo / kTileRays),
          v0_(rectangle.v_lo / kTileRays),
          wide_(rectangle.u_hi / kTileRays - u0_ + 1),
          counts_(static_cast<std::size_t>(wide_) * static_cast<std::size_t>(rectangle.v_hi / kTileRays - v0_ + 1)) {
        for_each_pair([&](std::size_t tile, std::size_t) { ++counts_[tile]; });
    }

    [[nodiscard]] std::size_t entries() const { return std::reduce(counts_.begin(), counts_.end(), std::size_t{0}); }
    [[nodiscard]] std::uint64_t cost() const {
        std::uint64_t cost = 0;
        for (const std::uint32_t count : counts_) {
            if (count > 0) cost += shared::kCutGroup * (kCutCost + kLookCost * count);
        }
        return cost;
    }

    void add_tasks(int axis, const Lattice& lattice, CutTasks& to) const {
        std::vector<std::uint32_t> at(counts_.size());
        auto next = static_cast<std::uint32_t>(to.order.size());
        for (std::size_t tile = 0; tile < counts_.size(); ++tile) {
            at[tile] = next;
            next += counts_[tile];
            if (counts_[tile] == 0) continue;
            const int u = (u0_ + static_cast<int>(tile) % wide_) * kTileRays;
            const int v = (v0_ + static_cast<int>(tile) / wide_) * kTileRays;
            to.tasks.push_back({axis, u, v, std::min(kTileRays, lattice.rays_u(axis) - u),
                                std::min(kTileRays, lattice.rays_v(axis) - v), at[tile], next, 0});
        }
        to.order.resize(next);
        for_each_pair(
            [&](std::size_t tile, std::size_t capsule) { to.order[at[tile]++] = static_cast<std::uint32_t>(capsule); });
    }

private:
    template <typename F>
    void for_each_pair(F&& f) const {
        for (std::size_t i = 0; i < footprints_.size(); ++i) {
            const Footprint& fp = footprints_[i];
            if (fp.empty()) continue;
            for (int v = fp.v_lo / kTileRays; v <= fp.v_hi / kTileRays; ++v) {
                for (int u = fp.u_lo / kTileRays; u <= fp.u_hi / kTileRays; ++u) {
                    f(static_cast<std::size_t>(v - v0_) * static_cast<std::size_t>(wide_) +
                          static_cast<std::size_t>(u - u0_),
                      i);
                }
            }
        }
    }

    std::span<const Footprint> footprints_;
    int u0_, v0_, wide_;
    std::vector<std::uint32_t> counts_;
};

}  // namespace

CutTasks cut_tasks(const Lattice& lattice, std::span<const Capsule> capsules, std::uint32_t most_groups) {
    CutTasks result;
    const auto count = static_cast<std::uint32_t>(capsules.size());
    result.order.resize(count);
    std::iota(result.order.begin(), result.order.end(), 0u);
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<Footprint> each = footprints(lattice, capsules, axis);
        const Footprint all = rectangle_around(each);
        if (all.empty()) continue;
        if (count > 1) {
            const std::uint64_t rays = static_cast<std::uint64_t>(all.u_hi - all.u_lo + 1) *
                                       static_cast<std::uint64_t>(all.v_hi - all.v_lo + 1);
            const Tiles tiles(all, each);
            if (tiles.cost() < rays * (kCutCost + kLookCost * count) &&
                result.order.size() + tiles.entries() <= kLongestOrder) {
                tiles.add_tasks(axis, lattice, result);
                continue;
            }
        }
        add_rectangle(axis, all, 0, count, static_cast<int>(std::min(most_groups, kMostTaskGroups)), result.tasks);
    }
    return result;
}

std::uint32_t append_pass(std::span<const CutTask> of_pass, std::vector<CutTask>& tasks) {
    std::uint32_t groups = 0;
    for (CutTask task : of_pass) {
        task.first_group = groups;
        groups += groups_of(task);
        tasks.push_back(task);
    }
    return groups;
}

}  // namespace burin::compute
