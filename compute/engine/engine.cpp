// SPDX-License-Identifier: MIT
#include "compute/engine/engine.hpp"

#include <utility>

#include "base/try.hpp"

namespace burin::compute {

Result<CarveStats> CarvingEngine::take_all() {
    CarveStats stats;
    while (under_way() > 0) {
        BURIN_TRY(delta, take(Wait::yes));
        stats += delta->stats;
        gather(delta->changes);
    }
    return stats;
}

Result<CarveStats> CarvingEngine::carve(std::span<const ToolSweep> sweeps) {
    BURIN_TRY_DO(begin(sweeps));
    return take_all();
}

Result<CarveStats> CarvingEngine::carve(std::span<const BallSweep> sweeps) {
    std::vector<ToolSweep> tools;
    tools.reserve(sweeps.size());
    for (const BallSweep& sweep : sweeps) {
        if (sweep.operation == Operation::smooth)
            return fail("tool", "cannot smooth along a sweep of a ball alone", "carve a ToolSweep");
        ToolSweep tool{.shape = BallTool{sweep.radius_m}, .start = {}, .end = {}};
        tool.start.position_m = sweep.start_object_m;
        tool.end.position_m = sweep.end_object_m;
        tool.operation = sweep.operation;
        tool.material = sweep.material;
        tools.push_back(std::move(tool));
    }
    return carve(tools);
}

Result<CarveStats> CarvingEngine::assign(const RayBatch& rays) {
    BURIN_TRY_DO(begin(rays));
    return take_all();
}

}  // namespace burin::compute
