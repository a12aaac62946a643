// SPDX-License-Identifier: MIT
// What any tool does to a solid: the one way from strokes to an engine.
//
// Cuts, fills and paint with a ball are the engine's own (CarvingEngine::carve), whole runs of them at a time. Everything else is
// worked out here: what the tool covers of each ray (tool_spans.hpp), the set algebra of that ray (ray_algebra.hpp), or the
// smoothed surface (smooth.hpp), and the rays that come out different are assigned. Both ways agree to the bit about a ball.
// The result does not depend on the number of threads, nor on which engine it is.
#pragma once

#include "compute/engine.hpp"
#include "compute/tool.hpp"

namespace burin {

// Carries the sweeps out in order; what is filled ends where the lattice ends. Fails, with the solid unchanged, on a sweep that
// cannot be (check_sweep in tool_spans.hpp; smoothing needs a ball and a strength from 0 to 1). When a device fails half-way,
// the solid is as the sweeps before left it. Touched rays are those the tool covers a part of, counted for each sweep.
[[nodiscard]] Result<CarveStats> apply(CarvingEngine& engine, std::span<const ToolSweep> sweeps, WorkerPool& pool);

}  // namespace burin
