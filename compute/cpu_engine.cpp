// SPDX-License-Identifier: MIT
// The native engine: rows of rays are dealt out to all cores; each ray takes the capsules one after the other.
#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "compute/engine.hpp"
#include "compute/sweep_units.hpp"

namespace burin {
namespace {

using shared::Capsule;
using shared::DexelEnd;
using shared::RayRef;
using shared::RaySpan;
using shared::uint;

// The list surgery of shaders/shared/cut_ray.h on host memory.
struct HostEnds {
    DexelEnd* ends;
    [[nodiscard]] DexelEnd load_end(uint i) const { return ends[i]; }
    void store_end(uint i, DexelEnd end) { ends[i] = end; }
#include "shaders/shared/cut_ray.h"
};

// One row of rays of one axis, with what happened to it.
struct Row {
    int axis, v, u_lo, u_hi;
    CutStats stats;
};

struct RayOutcome {
    bool touched = false, changed = false;
};

// A ray that needs more room than the store had left, the first capsule it has not taken yet, and what happened before.
struct PendingRay {
    int axis, u, v;
    uint room;
    std::size_t capsule;
    RayOutcome before;
};

class CpuEngine final : public CarvingEngine {
public:
    CpuEngine(Solid solid, WorkerPool& pool) : solid_(std::move(solid)), dirty_(solid_.lattice), pool_(pool) {
        dirty_.mark_all();
    }

    [[nodiscard]] const char* name() const override { return "cpu"; }
    [[nodiscard]] const Solid& solid() const override { return solid_; }
    [[nodiscard]] DirtyTiles& dirty_tiles() override { return dirty_; }

    [[nodiscard]] Result<CutStats> cut(std::span<const BallSweep> sweeps) override {
        const auto capsules = capsules_in_units(solid_, sweeps);
        if (!capsules) return std::unexpected(capsules.error());
        collect_rows(*capsules);
        pool_.run(rows_.size(), [&](std::size_t i) { cut_row(rows_[i], *capsules); });
        CutStats stats;
        for (const Row& row : rows_) {
            stats.rays_touched += row.stats.rays_touched;
            stats.rays_changed += row.stats.rays_changed;
        }
        finish_pending(*capsules, stats);
        return stats;
    }

private:
    void collect_rows(std::span<const Capsule> capsules) {
        rows_.clear();
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<Footprint>& footprints = footprints_[static_cast<std::size_t>(axis)];
            footprints.clear();
            row_ranges_.assign(static_cast<std::size_t>(solid_.lattice.rays_v(axis)), {1, 0});
            for (const Capsule& capsule : capsules) {
                const Footprint f = footprints.emplace_back(footprint(solid_.lattice, capsule, axis));
                for (int v = f.v_lo; v <= f.v_hi && f.u_lo <= f.u_hi; ++v) {
                    auto& [lo, hi] = row_ranges_[static_cast<std::size_t>(v)];
                    const bool fresh = lo > hi;
                    lo = fresh ? f.u_lo : std::min(lo, f.u_lo);
                    hi = fresh ? f.u_hi : std::max(hi, f.u_hi);
                }
            }
            for (std::size_t v = 0; v < row_ranges_.size(); ++v) {
                const auto [lo, hi] = row_ranges_[v];
                if (lo <= hi) rows_.push_back({axis, static_cast<int>(v), lo, hi, {}});
            }
        }
    }

    void cut_row(Row& row, std::span<const Capsule> capsules) {
        for (int u = row.u_lo; u <= row.u_hi; ++u) {
            count(cut_ray(row.axis, u, row.v, capsules, 0, {}), row.stats);
        }
    }

    static void count(const std::optional<RayOutcome>& outcome, CutStats& stats) {
        if (!outcome) return;  // pending: counted when it is finished
        stats.rays_touched += outcome->touched ? 1 : 0;
        stats.rays_changed += outcome->changed ? 1 : 0;
    }

    // Takes the capsules from first_capsule on out of one ray. Nothing when the ray has to wait for room.
    std::optional<RayOutcome> cut_ray(int axis, int u, int v, std::span<const Capsule> capsules,
                                      std::size_t first_capsule, RayOutcome outcome) {
        const std::vector<Footprint>& footprints = footprints_[static_cast<std::size_t>(axis)];
        for (std::size_t i = first_capsule; i < capsules.size(); ++i) {
            if (!footprints[i].holds(u, v)) continue;
            const shared::CapsuleRay from_ray =
                shared::capsule_from_ray(capsules[i], axis, u * shared::kUnitsPerCell, v * shared::kUnitsPerCell);
            const RaySpan span = shared::capsule_span(from_ray);
            if (span.lo > span.hi) continue;
            outcome.touched = true;
            const Taken taken = take_out(axis, u, v, span, from_ray, capsules[i].material);
            if (taken.room_needed > 0) {
                const std::lock_guard lock(pending_mutex_);
                pending_.push_back({axis, u, v, taken.room_needed, i, outcome});
                return std::nullopt;
            }
            outcome.changed = outcome.changed || taken.changed;
        }
        return outcome;
    }

    struct Taken {
        bool changed = false;
        uint room_needed = 0;  // above 0: the store is full and the ray is as it was
    };

    Taken take_out(int axis, int u, int v, RaySpan span, const shared::CapsuleRay& from_ray, uint material) {
        DexelSet& set = solid_.sets[static_cast<std::size_t>(axis)];
        RayRef& ray = set.rays()[static_cast<std::size_t>(v) * static_cast<std::size_t>(solid_.lattice.rays_u(axis)) +
                                 static_cast<std::size_t>(u)];
        const uint count = shared::count_of(ray);
        if (count == 0) return {};
        HostEnds list{set.store().data()};
        const HostEnds::CutPlan plan = list.plan_cut(ray.first, count, span);
        if (plan.removed == 0) return {};
        const uint new_count = list.count_after(count, plan);
        if (new_count > shared::room_of(ray) && !move_to_larger_room(set, ray, new_count)) {
            return {false, shared::room_of({0, DexelSet::count_room(new_count)})};
        }
        const auto end_at = [&](int depth) {
            return shared::make_end(depth, material, shared::capsule_normal(from_ray, axis, depth));
        };
        list.apply_cut(ray.first, count, plan, plan.kept_low != 0 ? end_at(span.lo) : DexelEnd{},
                       plan.kept_high != 0 ? end_at(span.hi) : DexelEnd{});
        ray.count_room = (ray.count_room & 0xff000000u) | new_count;
        dirty_.mark_ray(axis, u, v, plan.changed_lo, plan.changed_hi);
        return {true, 0};
    }

    // False when the store is full; the ray is then as it was.
    static bool move_to_larger_room(DexelSet& set, RayRef& ray, uint needed) {
        const uint count = shared::count_of(ray);
        const uint wanted = DexelSet::count_room(needed);
        const uint place = set.claim(shared::room_of({0, wanted}));
        if (place == DexelSet::kNoPlace) return false;
        std::copy_n(set.store().data() + ray.first, count, set.store().data() + place);
        ray = {place, (wanted & 0xff000000u) | count};
        return true;
    }

    void finish_pending(std::span<const Capsule> capsules, CutStats& stats) {
        while (!pending_.empty()) {
            const std::vector<PendingRay> pending = std::exchange(pending_, {});
            // At least what the waiting rays ask for, so that every round finishes the capsule each of them waits with.
            std::array<std::size_t, 3> needed{};
            for (const PendingRay& p : pending) needed[static_cast<std::size_t>(p.axis)] += p.room;
            for (std::size_t a = 0; a < 3; ++a) {
                DexelSet& set = solid_.sets[a];
                if (needed[a] > 0) set.make_space(std::max(set.used() / 4, 2 * needed[a] + 4096));
            }
            for (const PendingRay& p : pending) {
                count(cut_ray(p.axis, p.u, p.v, capsules, p.capsule, p.before), stats);
            }
        }
    }

    Solid solid_;
    DirtyTiles dirty_;
    WorkerPool& pool_;
    std::vector<Row> rows_;
    std::array<std::vector<Footprint>, 3> footprints_;  // of each capsule, for each axis
    std::vector<std::pair<int, int>> row_ranges_;       // u_lo, u_hi for each v
    std::mutex pending_mutex_;
    std::vector<PendingRay> pending_;  // guarded by pending_mutex_ while rows run
};

}  // namespace

std::unique_ptr<CarvingEngine> make_cpu_engine(Solid solid, WorkerPool& pool) {
    return std::make_unique<CpuEngine>(std::move(solid), pool);
}

}  // namespace burin
