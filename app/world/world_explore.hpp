// SPDX-License-Identifier: MIT
// burin world FILE --stroke STROKE: a simulated hand explores a world by touch, without window or device; what it felt
// of each object goes to the terminal and a report, with plots, and what it looked like into pictures.
#pragma once

#include "app/recordings/wand_stroke.hpp"
#include "base/error.hpp"

namespace burin::app {

// Fails with all problems of the world printed, when it has some.
[[nodiscard]] Result<void> explore_world(const WorldExploration& options);

// Prints that the hand's motion is not as large as the tool's in the world; nothing where it is.
void print_motion_scaled(double scene_from_device_scale);

}  // namespace burin::app
