// SPDX-License-Identifier: MIT
// Plots what was felt of a world: over time the force on the hand and how far the hand was beyond where its tool
// rested, a line for each object touched. So stiff and soft, rough and smooth things are told apart at a glance.
#pragma once

#include <string>

#include "activities/world/felt_world.hpp"

namespace burin::activities {

// Returns the figure as SVG text. Objects that were touched longest come first; as many as a legend holds.
[[nodiscard]] std::string world_figure(const WorldFigures& figures);

// Returns a figure of the force over the depth, a line for each object, whose slope is the stiffness that was felt.
[[nodiscard]] std::string depth_figure(const WorldFigures& figures);

}  // namespace burin::activities
