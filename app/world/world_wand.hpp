// SPDX-License-Identifier: MIT
// burin world FILE --stroke STROKE --device simulated-wand[:DESCRIPTION]: a simulated hand explores a world with a
// wand; what each of its points felt of each object goes to the terminal and a report, with a table and plots, and what
// it looked like into pictures.
#pragma once

#include "app/world/world_explore.hpp"
#include "base/error.hpp"

namespace burin::app {

// Fails with all problems of the world printed, when it has some.
[[nodiscard]] Result<void> explore_world_with_wand(const WorldExploration& options);

}  // namespace burin::app
