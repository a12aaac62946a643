// SPDX-License-Identifier: MIT
// Applies tool sweeps of any kind to an engine's solid. All strokes reach an engine this way, except balls that a
// DeviceSurface carves without waiting (compute/vulkan/device_surface.hpp).
//
// Consecutive cuts, fills and paint with a ball are passed to the engine itself (CarvingEngine::carve) in one call.
// Everything else is computed here: what the tool covers of each ray (tool_spans.hpp) and the set algebra of that ray
// (set_algebra.hpp), or the smoothed surface (smooth.hpp). The rays whose ends differ are then assigned. For a ball,
// both ways agree to the bit.
// The result depends neither on the number of threads nor on the kind of engine.
#pragma once

#include "compute/rays/engine.hpp"
#include "compute/tools/tool.hpp"

namespace burin::compute {

// Checks a sweep as apply() does: check_sweep (tool_spans.hpp), and what smoothing asks for besides, a ball of at most
// 100 cells and a strength from 0 to 1.
[[nodiscard]] Result<void> check_tool(const Solid& solid, const ToolSweep& sweep);

// Carries out the sweeps in order; filled material is clipped to the lattice. Fails, with the solid unchanged, on an
// invalid sweep (check_tool). When a device fails part of the way, the solid holds the result of the sweeps before.
// Touched rays are those of which the tool covers a part, counted for each sweep.
[[nodiscard]] Result<CarveStats> apply(CarvingEngine& engine, std::span<const ToolSweep> sweeps, WorkerPool& pool);

}  // namespace burin::compute
