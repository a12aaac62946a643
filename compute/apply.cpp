// SPDX-License-Identifier: MIT
#include "compute/apply.hpp"

#include <algorithm>
#include <vector>

#include "compute/ray_algebra.hpp"
#include "compute/tool_spans.hpp"

namespace burin {
namespace {

bool is_for_engine(const ToolSweep& sweep) {
    return std::holds_alternative<BallTool>(sweep.shape) && sweep.operation != Operation::smooth;
}

BallSweep ball_sweep(const ToolSweep& sweep) {
    return {sweep.start.position_m, sweep.end.position_m, std::get<BallTool>(sweep.shape).radius_m, sweep.material,
            sweep.operation};
}

Result<void> check(const Solid& solid, const ToolSweep& sweep) {
    if (sweep.operation == Operation::smooth) {
        if (!std::holds_alternative<BallTool>(sweep.shape)) {
            return fail("tool", "cannot smooth: only a ball has a middle to smooth from", "use --tool ball:R");
        }
        if (!(sweep.smooth_strength >= 0.0 && sweep.smooth_strength <= 1.0)) {
            return fail("smooth strength", "is outside 0 to 1", "give a strength from 0 to 1");
        }
    }
    return check_sweep(solid, sweep);
}

void append_result(Operation operation, RayEnds held, RayEnds covered, std::vector<shared::DexelEnd>& to) {
    switch (operation) {
        case Operation::cut: return append_difference(held, covered, to);
        case Operation::fill: return append_union(held, covered, to);
        case Operation::paint: return append_painted(held, covered, to);
        case Operation::smooth: break;  // not done ray by ray
    }
}

// The rays of `covered` whose ends the operation changes.
RayBatch changed_rays(const Solid& solid, const RayBatch& covered, Operation operation, WorkerPool& pool) {
    constexpr std::size_t kRaysATask = 1024;
    std::vector<RayBatch> parts((covered.rays.size() + kRaysATask - 1) / kRaysATask);
    pool.run(parts.size(), [&](std::size_t i) {
        std::vector<shared::DexelEnd> ends;
        const std::size_t last = std::min(covered.rays.size(), (i + 1) * kRaysATask);
        for (std::size_t r = i * kRaysATask; r < last; ++r) {
            const RayBatch::Ray& ray = covered.rays[r];
            const RayPlace place = place_of(ray.code);
            const RayEnds held = solid.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
            if (held.empty() && operation != Operation::fill) continue;
            ends.clear();
            append_result(operation, held, covered.ends_of(ray), ends);
            if (!same_ends(held, ends)) parts[i].add(ray.code, ends);
        }
    });
    RayBatch changed;
    for (const RayBatch& part : parts) {
        for (const RayBatch::Ray& ray : part.rays) changed.add(ray.code, part.ends_of(ray));
    }
    return changed;
}

Result<CarveStats> apply_on_host(CarvingEngine& engine, const ToolSweep& sweep, WorkerPool& pool) {
    const Result<RayBatch> covered = tool_spans(engine.solid(), sweep, pool);
    if (!covered) return std::unexpected(covered.error());
    Result<CarveStats> stats = engine.assign(changed_rays(engine.solid(), *covered, sweep.operation, pool));
    if (stats) stats->rays_touched = covered->rays.size();
    return stats;
}

}  // namespace

Result<CarveStats> apply(CarvingEngine& engine, std::span<const ToolSweep> sweeps, WorkerPool& pool) {
    for (const ToolSweep& sweep : sweeps) {
        if (const auto good = check(engine.solid(), sweep); !good) return std::unexpected(good.error());
    }
    CarveStats stats;
    std::vector<BallSweep> balls;
    for (std::size_t i = 0; i < sweeps.size();) {
        balls.clear();
        while (i < sweeps.size() && is_for_engine(sweeps[i])) balls.push_back(ball_sweep(sweeps[i++]));
        const Result<CarveStats> done = balls.empty() ? apply_on_host(engine, sweeps[i++], pool) : engine.carve(balls);
        if (!done) return done;
        stats += *done;
    }
    return stats;
}

}  // namespace burin
