// SPDX-License-Identifier: MIT
// The carving engine for the CPU. Rows of rays are distributed over all cores in bands; each row applies the capsules
// in order.
//
// Most of its speed comes from work that is avoided: rows and rays outside a capsule are never visited, a page of empty
// rays is skipped at once, and a ray whose intervals do not meet a span costs one comparison. A band owns whole rows,
// so no two threads write to the same page.
#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/try.hpp"
#include "compute/cpu/ball_spans.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "compute/engine/engine.hpp"
#include "compute/tools/apply.hpp"
#include "compute/tools/sweep_units.hpp"

namespace burin::compute {
namespace {

using shared::Capsule;
using shared::CapsuleRay;
using shared::DexelEnd;
using shared::kUnitsPerCell;
using shared::RaySpan;
using shared::uint;
constexpr int kPageRays = DexelSet::kPageRays;

// Applies shaders/shared/span_edit.h to ends in host memory.
struct HostRay {
    const DexelEnd* ends;
    [[nodiscard]] DexelEnd load_end(uint i) const { return ends[i]; }
#include "shaders/shared/span_edit.h"
};

// Rows v_lo..v_hi of one axis, with the changes to their rays and the counts of rays touched and changed. Aligned to
// cache lines of its own, because threads write to neighbouring bands all the time.
struct alignas(128) Band {
    int axis = 0, v_lo = 0, v_hi = 0;
    CarveStats stats;
    Changes changes;
};

// Effect of an operation on a ray. A cut or paint misses rays without material, and a fill misses rays on the lattice's
// border.
enum class Outcome { missed, touched, changed };

void count(Band& band, Outcome outcome) {
    band.stats.rays_touched += outcome != Outcome::missed ? 1 : 0;
    band.stats.rays_changed += outcome == Outcome::changed ? 1 : 0;
}

// The ends that a resting ball leaves in one page. They are put into the solid without normals, which are computed
// together afterwards.
class NewEnds {
public:
    NewEnds(const Capsule& ball, int axis, int v) : ball_(ball), axis_(axis), v_(v) {}

    // Returns the new ends of an edit, in order; valid until the next call.
    [[nodiscard]] std::span<const DexelEnd> add(int u, const HostRay::SpanEdit& edit, RaySpan span) {
        std::size_t added = 0;
        if (edit.insert_lo != 0) ends_[added++] = place(u, edit.from, span.lo);
        if (edit.insert_hi != 0) ends_[added++] = place(u, edit.from + edit.insert_lo, span.hi);
        return {ends_.data(), added};
    }

    void give_normals(DexelSet& set) {
        std::array<std::uint32_t, kMost> codes;
        direction_codes(static_cast<std::int32_t>(count_), x_.data(), y_.data(), z_.data(), codes.data());
        for (std::size_t i = 0; i < count_; ++i) set.ends_to_change(u_[i], v_)[in_ray_[i]].normal = codes[i];
    }

private:
    static constexpr std::size_t kMost = 2 * kPageRays;

    // Makes an end and stores its normal's direction, from the end to the ball's centre, which is out of the material.
    DexelEnd place(int u, uint in_ray, int depth) {
        const int at_u = u * kUnitsPerCell, at_v = v_ * kUnitsPerCell;
        x_[count_] = ball_.start_x - shared::pick(axis_, depth, at_v, at_u);
        y_[count_] = ball_.start_y - shared::pick(axis_, at_u, depth, at_v);
        z_[count_] = ball_.start_z - shared::pick(axis_, at_v, at_u, depth);
        u_[count_] = u;
        in_ray_[count_++] = in_ray;
        return shared::make_end(depth, shared::material_of_work(ball_), 0);
    }

    const Capsule& ball_;
    int axis_, v_;
    std::size_t count_ = 0;
    std::array<std::int32_t, kMost> x_, y_, z_;
    std::array<int, kMost> u_;
    std::array<uint, kMost> in_ray_;
    std::array<DexelEnd, 2> ends_;
};

// A capsule and the range of rays in a row that it may touch.
struct RowPart {
    const Capsule* capsule;
    int u_lo, u_hi;
};

class CpuEngine final : public CarvingEngine {
public:
    CpuEngine(Solid solid, WorkerPool& pool) : solid_(std::move(solid)), pool_(pool) {}

    [[nodiscard]] const char* name() const override { return "cpu"; }
    [[nodiscard]] const Solid& solid() const override { return solid_; }
    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) override {
        return burin::compute::add_material(solid_, material);
    }

    [[nodiscard]] Result<Ticket> begin(std::span<const ToolSweep> sweeps) override {
        for (const ToolSweep& sweep : sweeps) BURIN_TRY_DO(check_tool(solid_, sweep));
        waiting_.emplace_back(std::vector(sweeps.begin(), sweeps.end()));
        return ++begun_;
    }
    [[nodiscard]] Result<Ticket> begin(RayBatch rays) override {
        waiting_.emplace_back(std::move(rays));
        return ++begun_;
    }
    [[nodiscard]] std::size_t under_way() const override { return waiting_.size(); }

    // The work is done here, where its result is asked for.
    [[nodiscard]] Result<std::optional<Delta>> take(Wait) override {
        if (waiting_.empty()) return std::nullopt;
        Delta delta{begun_ - waiting_.size() + 1, {}, {}, {}};
        const auto work = std::move(waiting_.front());
        waiting_.pop_front();
        if (const RayBatch* const rays = std::get_if<RayBatch>(&work)) {
            delta.stats = {rays->rays.size(), assign_rays(*rays)};
        } else {
            BURIN_TRY(stats, carry_out(std::get<std::vector<ToolSweep>>(work)));
            delta.stats = stats;
        }
        delta.changes = changes_.take();
        return delta;
    }

private:
    [[nodiscard]] Result<CarveStats> carry_out(std::span<const ToolSweep> sweeps) {
        CarveStats stats;
        std::vector<BallSweep> balls;
        for (std::size_t i = 0; i < sweeps.size();) {
            balls.clear();
            while (i < sweeps.size() && is_ball_cut(sweeps[i])) balls.push_back(ball_sweep(sweeps[i++]));
            const Result<CarveStats> done =
                balls.empty() ? apply_on_host(solid_, sweeps[i++], pool_,
                                              [this](const RayBatch& rays) { return assign_rays(rays); })
                              : carve_balls(balls);
            if (!done) return done;
            stats += *done;
        }
        return stats;
    }

    [[nodiscard]] Result<CarveStats> carve_balls(std::span<const BallSweep> sweeps) {
        BURIN_TRY(capsules, capsules_in_units(solid_, sweeps));
        deal_out(capsules);
        pool_.run(band_count_, [&](std::size_t i) { carve_band(bands_[i], capsules); });
        return collect();
    }

    std::uint64_t assign_rays(const RayBatch& batch) {
        std::uint64_t changed = 0;
        for (const RayBatch::Ray& ray : batch.rays) {
            const RayPlace place = place_of(ray.code);
            DexelSet& set = solid_.sets[static_cast<std::size_t>(place.axis)];
            if (assign_ray(set, place, batch.ends_of(ray), changes_)) ++changed;
        }
        return changed;
    }

    // Splits the rows into bands with about equal numbers of rays to visit. Makes few bands when there is little to do,
    // since waking the other cores costs as much as some hundred rays.
    void deal_out(std::span<const Capsule> capsules) {
        constexpr std::uint64_t kLeastRays = 500;
        std::array<std::vector<std::uint64_t>, 3> rays_of_row;
        std::uint64_t all = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            rays_of_row[a].assign(static_cast<std::size_t>(solid_.lattice.rays_v(axis)), 0);
            footprints_[a].clear();
            for (const Capsule& capsule : capsules) {
                const Footprint f = footprints_[a].emplace_back(footprint(solid_.lattice, capsule, axis));
                if (f.empty()) continue;
                const auto width = static_cast<std::uint64_t>(f.u_hi - f.u_lo + 1);
                for (int v = f.v_lo; v <= f.v_hi; ++v) rays_of_row[a][static_cast<std::size_t>(v)] += width;
                all += width * static_cast<std::uint64_t>(f.v_hi - f.v_lo + 1);
            }
        }
        const std::uint64_t wanted = std::clamp<std::uint64_t>(all / kLeastRays, 1, pool_.threads() * 4ull);
        const std::uint64_t share = all / wanted + 1;
        band_count_ = 0;
        std::uint64_t in_band = 0;
        for (int axis = 0; axis < 3; ++axis) {
            bool open = false;
            const std::vector<std::uint64_t>& rays = rays_of_row[static_cast<std::size_t>(axis)];
            for (int v = 0; v < static_cast<int>(rays.size()); ++v) {
                if (rays[static_cast<std::size_t>(v)] == 0) continue;
                if (!open || in_band >= share) {
                    open_band(axis, v);
                    open = true;
                    in_band = 0;
                }
                bands_[band_count_ - 1].v_hi = v;
                in_band += rays[static_cast<std::size_t>(v)];
            }
        }
    }

    void open_band(int axis, int v) {
        if (band_count_ == bands_.size()) bands_.emplace_back();
        Band& band = bands_[band_count_++];
        band.axis = axis;
        band.v_lo = v;
        band.stats = {};
        band.changes.rays.clear();
        band.changes.before.clear();
    }

    void carve_band(Band& band, std::span<const Capsule> capsules) {
        std::vector<RowPart> parts;
        const std::vector<Footprint>& footprints = footprints_[static_cast<std::size_t>(band.axis)];
        for (int v = band.v_lo; v <= band.v_hi; ++v) {
            parts.clear();
            for (std::size_t i = 0; i < capsules.size(); ++i) {
                const Footprint& f = footprints[i];
                if (!f.empty() && v >= f.v_lo && v <= f.v_hi) parts.push_back({&capsules[i], f.u_lo, f.u_hi});
            }
            if (parts.size() == 1) {
                carve_row(band, v, parts.front());
            } else if (!parts.empty()) {
                carve_row_by_rays(band, v, parts);
            }
        }
    }

    // Applies one capsule to a row. Sections with a resting ball are computed for many rays at a time.
    void carve_row(Band& band, int v, const RowPart& part) {
        const Capsule& c = *part.capsule;
        if (c.along_x != 0 || c.along_y != 0 || c.along_z != 0) {
            for (int u = part.u_lo; u <= part.u_hi; ++u) {
                if (skips_page(band.axis, u, v, c)) continue;
                const CapsuleRay from_ray = capsule_from_ray(c, band.axis, u * kUnitsPerCell, v * kUnitsPerCell);
                count(band, work_on(band, u, v, shared::capsule_span(from_ray), c));
            }
            return;
        }
        const int center_u = shared::pick(band.axis, c.start_y, c.start_z, c.start_x);
        const int center_v = shared::pick(band.axis, c.start_z, c.start_x, c.start_y);
        const int center_s = shared::pick(band.axis, c.start_x, c.start_y, c.start_z);
        const std::int64_t offset_v = v * kUnitsPerCell - center_v;
        const std::int64_t row_radius2 = c.radius2 - offset_v * offset_v;
        if (row_radius2 < 0) return;
        const auto reach = static_cast<int>(shared::whole_sqrt(row_radius2));
        const int u_lo = std::max(part.u_lo, -floor_cells(reach - center_u)),
                  u_hi = std::min(part.u_hi, floor_cells(center_u + reach));
        std::array<std::int32_t, kPageRays> half;
        for (int u = u_lo; u <= u_hi;) {
            const int last = std::min(u_hi, u / kPageRays * kPageRays + kPageRays - 1);
            if (skips_page(band.axis, u, v, c)) {
                u = last + 1;
                continue;
            }
            ball_half_spans(row_radius2, u * kUnitsPerCell - center_u, last - u + 1, half.data());
            if (operation_of(c) == shared::kCut) {
                cut_page(band, u, last, v, center_s, half, c);
                u = last + 1;
                continue;
            }
            for (int i = 0; u <= last; ++u, ++i) {
                const int h = half[static_cast<std::size_t>(i)];
                count(band, work_on(band, u, v, {center_s - h, center_s + h}, c));
            }
        }
    }

    // Cuts the rays u .. last of one page, each by half[i] to both sides of center_s. Most of them hold one interval,
    // and a stroke leaves half of those alone, which takes two comparisons to find out. The normals of the new ends are
    // computed together.
    void cut_page(Band& band, int u, int last, int v, int center_s, const std::array<std::int32_t, kPageRays>& half,
                  const Capsule& c) {
        DexelSet& set = solid_.sets[static_cast<std::size_t>(band.axis)];
        DexelSet::Run run = set.run(u, v);
        NewEnds fresh(c, band.axis, v);
        for (int i = 0; u + i <= last; ++i) {
            const std::span<const DexelEnd> held = run.ends_of(i);
            if (held.empty()) continue;
            ++band.stats.rays_touched;
            const int h = half[static_cast<std::size_t>(i)];
            const RaySpan span{center_s - h, center_s + h};
            if (depth_of(held.front()) >= span.hi || depth_of(held.back()) <= span.lo) continue;
            HostRay ray{held.data()};
            const HostRay::SpanEdit edit = ray.plan_span(static_cast<uint>(held.size()), span, 0);
            if (!ray.changes_anything(edit)) continue;
            ++band.stats.rays_changed;
            band.changes.record({band.axis, u + i, v}, edit.changed_lo, edit.changed_hi, held);
            set.splice(u + i, v, edit.from, edit.to - edit.from, fresh.add(u + i, edit, span));
            run = set.run(u, v);  // splice may have moved the page
            if (run.ends == nullptr) return;
        }
        fresh.give_normals(set);
    }

    // Applies several capsules to a row. Each ray takes all of them in order and is counted once.
    void carve_row_by_rays(Band& band, int v, std::span<const RowPart> parts) {
        int u_lo = parts.front().u_lo, u_hi = parts.front().u_hi;
        for (const RowPart& p : parts) {
            u_lo = std::min(u_lo, p.u_lo);
            u_hi = std::max(u_hi, p.u_hi);
        }
        for (int u = u_lo; u <= u_hi; ++u) {
            Outcome of_ray = Outcome::missed;
            for (const RowPart& p : parts) {
                if (u < p.u_lo || u > p.u_hi) continue;
                const CapsuleRay from_ray =
                    capsule_from_ray(*p.capsule, band.axis, u * kUnitsPerCell, v * kUnitsPerCell);
                of_ray = std::max(of_ray, work_on(band, u, v, shared::capsule_span(from_ray), *p.capsule));
            }
            count(band, of_ray);
        }
    }

    // Returns whether the page of (u, v) can be skipped: without material there is nothing to cut or paint.
    [[nodiscard]] bool skips_page(int axis, int u, int v, const Capsule& c) const {
        return operation_of(c) != shared::kFill && !solid_.sets[static_cast<std::size_t>(axis)].page_held(u, v);
    }

    [[nodiscard]] static int floor_cells(int units) {
        return units >= 0 ? units / kUnitsPerCell : -((-units + kUnitsPerCell - 1) / kUnitsPerCell);
    }

    Outcome work_on(Band& band, int u, int v, RaySpan span, const Capsule& capsule) {
        if (span.lo > span.hi) return Outcome::missed;
        DexelSet& set = solid_.sets[static_cast<std::size_t>(band.axis)];
        const std::span<const DexelEnd> held = set.ends(u, v);
        const int operation = operation_of(capsule), cells = solid_.lattice.cells[static_cast<std::size_t>(band.axis)];
        if (operation == shared::kFill) {
            if (!shared::may_fill_ray(u, v, set.rays_u(), set.rays_v())) return Outcome::missed;
            span = shared::fill_within(span, cells);
        } else if (held.empty()) {
            return Outcome::missed;
        } else if (operation == shared::kPaint) {
            return paint(band, u, v, span, shared::material_of_work(capsule));
        } else if (depth_of(held.front()) >= span.hi || depth_of(held.back()) <= span.lo) {
            return Outcome::touched;  // true of half of the rays that a stroke touches
        }
        HostRay ray{held.data()};
        const HostRay::SpanEdit edit =
            ray.plan_span(static_cast<uint>(held.size()), span, operation == shared::kFill ? 1u : 0u);
        if (!ray.changes_anything(edit)) return Outcome::touched;
        band.changes.record({band.axis, u, v}, edit.changed_lo, edit.changed_hi, held);
        std::array<DexelEnd, 2> fresh;
        std::size_t count = 0;
        const CapsuleRay from_ray = capsule_from_ray(capsule, band.axis, u * kUnitsPerCell, v * kUnitsPerCell);
        if (edit.insert_lo != 0) fresh[count++] = capsule_end(from_ray, band.axis, span.lo, capsule.work, cells);
        if (edit.insert_hi != 0) fresh[count++] = capsule_end(from_ray, band.axis, span.hi, capsule.work, cells);
        set.splice(u, v, edit.from, edit.to - edit.from, {fresh.data(), count});
        return Outcome::changed;
    }

    Outcome paint(Band& band, int u, int v, RaySpan span, uint material) {
        int lo = shared::kMaxDepth, hi = -1;
        const std::span<DexelEnd> held = solid_.sets[static_cast<std::size_t>(band.axis)].ends_to_change(u, v);
        for (const DexelEnd& end : held) {
            const int depth = depth_of(end);
            if (depth < span.lo || depth > span.hi || material_of(end) == material) continue;
            lo = std::min(lo, depth);
            hi = depth;
        }
        if (lo > hi) return Outcome::touched;
        band.changes.record({band.axis, u, v}, lo, hi, held);
        for (DexelEnd& end : held) {
            if (depth_of(end) >= lo && depth_of(end) <= hi) end = shared::make_end(depth_of(end), material, end.normal);
        }
        return Outcome::changed;
    }

    CarveStats collect() {
        CarveStats stats;
        std::size_t rays = changes_.rays.size(), ends = changes_.before.size();
        for (std::size_t i = 0; i < band_count_; ++i) {
            rays += bands_[i].changes.rays.size();
            ends += bands_[i].changes.before.size();
        }
        changes_.rays.reserve(rays);
        changes_.before.reserve(ends);
        for (std::size_t i = 0; i < band_count_; ++i) {
            stats += bands_[i].stats;
            changes_.append(bands_[i].changes);
        }
        return stats;
    }

    Solid solid_;
    WorkerPool& pool_;
    Changes changes_;
    Ticket begun_ = 0;
    std::deque<std::variant<std::vector<ToolSweep>, RayBatch>> waiting_;  // the updates that were not taken
    std::array<std::vector<Footprint>, 3> footprints_;                    // of each capsule, by axis
    // Only the first band_count_ are in use; the others keep their memory.
    std::vector<Band> bands_;
    std::size_t band_count_ = 0;
};

}  // namespace

std::unique_ptr<CarvingEngine> make_cpu_engine(Solid solid, WorkerPool& pool) {
    return std::make_unique<CpuEngine>(std::move(solid), pool);
}

std::string threads_of(const WorkerPool& pool) { return std::to_string(pool.threads()) + " threads"; }

ChosenEngine on_processor(Solid solid, WorkerPool& pool) {
    return {make_cpu_engine(std::move(solid), pool), threads_of(pool), false, ""};
}

}  // namespace burin::compute
