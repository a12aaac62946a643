// SPDX-License-Identifier: MIT
// The tools that carve the places of STROKE-1000: the ball of its scenes, or another tool in the ball's place. The
// others are as tall as the ball, remove about as much of the cube at a place (to a twentieth), and lean by 12 degrees,
// so that no face of theirs lies along the lattice.
#pragma once

#include <cstdint>
#include <string>

#include "bench/measure/scenes.hpp"
#include "compute/tools/tool.hpp"

namespace burin::bench {

enum class StrokeTool : std::uint8_t { ball, cylinder, cone, bullnose, box };
[[nodiscard]] std::string name_of(StrokeTool tool);  // "bullnose"

// Returns one of the scene's sweeps with the tool in its ball's place, object frame.
[[nodiscard]] compute::ToolSweep tool_sweep(const CarveScene& scene, const compute::BallSweep& sweep_scene,
                                            StrokeTool tool);

}  // namespace burin::bench
