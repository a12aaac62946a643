// SPDX-License-Identifier: MIT
#include "compute/tools/apply.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/try.hpp"
#include "compute/rays/set_algebra.hpp"
#include "compute/tools/smooth.hpp"
#include "compute/tools/smooth_cover.hpp"
#include "compute/tools/tool_spans.hpp"
#include "shaders/shared/capsule.h"

namespace burin::compute {
namespace {

void append_result(Operation operation, RayEnds held, RayEnds covered, std::vector<shared::DexelEnd>& to) {
    switch (operation) {
        case Operation::cut: return append_difference(held, covered, to);
        case Operation::fill: return append_union(held, covered, to);
        case Operation::paint: return append_painted(held, covered, to);
        case Operation::smooth: break;  // computed by smoothed_rays
    }
}

// Clips the intervals that a tool covers of a ray to those that may be filled: none on rays along the lattice's border,
// and on other rays only depths within it (shaders/shared/capsule.h). Where an interval is clipped, its normal is along
// the ray. The result may lie in `kept`.
RayEnds fillable(const Lattice& lattice, const RayPlace& place, RayEnds covered, std::vector<shared::DexelEnd>& kept) {
    if (!shared::may_fill_ray(place.u, place.v, lattice.rays_u(place.axis), lattice.rays_v(place.axis))) return {};
    const int cells = lattice.cells[static_cast<std::size_t>(place.axis)];
    kept.clear();
    for (std::size_t i = 0; i < covered.size(); i += 2) {
        const shared::RaySpan whole{depth_of(covered[i]), depth_of(covered[i + 1])};
        const shared::RaySpan within = shared::fill_within(whole, cells);
        if (within.lo >= within.hi) continue;
        const auto end = [&](const shared::DexelEnd& e, int depth, bool upper) {
            return depth == depth_of(e)
                       ? e
                       : shared::make_end(depth, material_of(e), shared::axis_normal(place.axis, upper));
        };
        kept.push_back(end(covered[i], within.lo, false));
        kept.push_back(end(covered[i + 1], within.hi, true));
    }
    return kept;
}

// Returns the rays of `covered` whose ends the operation changes.
RayBatch changed_rays(const Solid& solid, const RayBatch& covered, Operation operation, WorkerPool& pool) {
    constexpr std::size_t kRaysATask = 1024;
    std::vector<RayBatch> parts((covered.rays.size() + kRaysATask - 1) / kRaysATask);
    pool.run(parts.size(), [&](std::size_t i) {
        std::vector<shared::DexelEnd> ends, kept;
        const std::size_t last = std::min(covered.rays.size(), (i + 1) * kRaysATask);
        for (std::size_t r = i * kRaysATask; r < last; ++r) {
            const RayBatch::Ray& ray = covered.rays[r];
            const RayPlace place = place_of(ray.code);
            const RayEnds held = solid.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
            if (held.empty() && operation != Operation::fill) continue;
            ends.clear();
            const RayEnds by_tool = operation == Operation::fill
                                        ? fillable(solid.lattice, place, covered.ends_of(ray), kept)
                                        : covered.ends_of(ray);
            append_result(operation, held, by_tool, ends);
            if (!same_ends(held, ends)) parts[i].add(ray.code, ends);
        }
    });
    RayBatch changed;
    for (const RayBatch& part : parts) {
        for (const RayBatch::Ray& ray : part.rays) changed.add(ray.code, part.ends_of(ray));
    }
    return changed;
}

}  // namespace

Result<CarveStats> apply_on_host(const Solid& solid, const ToolSweep& sweep, WorkerPool& pool, const AssignRays& assign,
                                 std::size_t first_ball) {
    CarveStats stats;
    const auto counted = [&](const RayBatch& rays) { stats.rays_changed += assign(rays); };
    if (sweep.operation == Operation::smooth) {
        const SmoothBalls balls(sweep);
        for (std::size_t i = first_ball; i < balls.size(); ++i) counted(smoothed_rays(solid, balls[i], pool));
        stats.rays_touched = stats.rays_changed;
        return stats;
    }
    BURIN_TRY(covered, tool_spans(solid, sweep, pool));
    counted(changed_rays(solid, covered, sweep.operation, pool));
    stats.rays_touched = covered.rays.size();
    return stats;
}

Result<void> check_tool(const Solid& solid, const ToolSweep& sweep) {
    if (sweep.operation == Operation::smooth) {
        if (!(sweep.smooth_strength >= 0.0 && sweep.smooth_strength <= 1.0)) {
            return fail("smooth strength", "is outside 0 to 1", "give a strength from 0 to 1");
        }
        BURIN_TRY_DO(check_sweep(solid, sweep));
        const double radius_m = smooth_cover(sweep.shape).radius_m;
        const Vec3 along = sweep.end.position_m - sweep.start.position_m;
        if (radius_m > kLargestSmoothCells * solid.lattice.spacing_m || glm::length(along) > 4096.0 * radius_m) {
            return fail("tool", "is too large, or goes too far at once, to smooth with",
                        "choose a tool of at most 100 lattice cells, and more rows in the stroke");
        }
        return {};
    }
    return check_sweep(solid, sweep);
}

bool is_ball_cut(const ToolSweep& sweep) {
    return std::holds_alternative<BallTool>(sweep.shape) && sweep.operation != Operation::smooth;
}

BallSweep ball_sweep(const ToolSweep& sweep) {
    return {sweep.start.position_m, sweep.end.position_m, std::get<BallTool>(sweep.shape).radius_m, sweep.material,
            sweep.operation};
}

}  // namespace burin::compute
