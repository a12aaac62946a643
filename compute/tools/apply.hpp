// SPDX-License-Identifier: MIT
// Checks whether sweeps of tools can be carried out, and carries out on the host those that an engine has no way of its
// own for.
//
// Cuts, fills and paint with a ball are an engine's own (sweep_units.hpp). For everything else it is computed here what
// the tool covers of each ray (tool_spans.hpp) and the set algebra of that ray (set_algebra.hpp), or the smoothed
// surface (smooth.hpp), and the engine assigns the rays whose ends differ. For a ball, both ways agree to the bit. The
// result does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>

#include "base/error.hpp"
#include "base/worker_pool.hpp"
#include "compute/rays/carve_stats.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"
#include "compute/tools/ball_sweep.hpp"
#include "compute/tools/tool.hpp"

namespace burin::compute {

// Checks a sweep as an engine does before it begins an update: check_sweep (tool_spans.hpp), and what smoothing asks
// for besides, a ball of at most 100 cells and a strength from 0 to 1.
[[nodiscard]] Result<void> check_tool(const Solid& solid, const ToolSweep& sweep);

// Says whether a sweep cuts, fills or paints with a ball, and returns it as such.
[[nodiscard]] bool is_ball_cut(const ToolSweep& sweep);
[[nodiscard]] BallSweep ball_sweep(const ToolSweep& sweep);

// Assigns the rays to the solid, and returns how many of them changed.
using AssignRays = std::function<std::uint64_t(const RayBatch&)>;

// Carries out a sweep that check_tool accepts. `assign` is called once, or once for each ball that smooths, and must
// change this solid. Touched rays are those of which the tool covers a part; of a sweep that smooths, those changed. Of
// such a sweep, the balls before `first_ball` have been carried out already (SmoothBalls).
[[nodiscard]] Result<CarveStats> apply_on_host(const Solid& solid, const ToolSweep& sweep, WorkerPool& pool,
                                               const AssignRays& assign, std::size_t first_ball = 0);

}  // namespace burin::compute
