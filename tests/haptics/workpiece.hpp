// SPDX-License-Identifier: MIT
// A carved solid to touch: a ball of radius 0.4 m on 40 cells a side, cut with a ball tool.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"

namespace burin::haptics::test {

inline constexpr double kToolRadius_m = 0.06;

struct Workpiece {
    WorkerPool pool{2};
    std::unique_ptr<compute::CarvingEngine> engine;
    std::unique_ptr<burin::compute::Surface> surface;

    Workpiece() : engine(compute::make_cpu_engine(*compute::make_ball(0.4, 40, {"ball", {}}), pool)) {
        surface = std::make_unique<burin::compute::Surface>(engine->solid().lattice);
        surface->mesh_all(engine->solid(), pool);
    }
    void cut(const Vec3& from, const Vec3& to) {
        const compute::BallSweep sweep{from, to, kToolRadius_m, 0};
        ASSERT_TRUE(engine->carve({&sweep, 1}));
        surface->update(engine->solid(), engine->take_changes(), pool);
    }
};

}  // namespace burin::haptics::test
