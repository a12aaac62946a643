// SPDX-License-Identifier: MIT
// burin world FILE --stroke STROKE: a simulated hand explores a world by touch, without window or device; what it felt
// of each object goes to the terminal and a report, with plots, and what it looked like into pictures.
#pragma once

#include <string>

#include "base/error.hpp"

namespace burin::app {

struct WorldExploration {
    std::string world;                 // a world.toml or a .wrl (docs/formats.md)
    std::string stroke;                // a CSV file; its button has no meaning here
    double radius_m = 0.004;           // of the ball that touches
    std::string pictures;              // a folder; empty: none
    std::string report;                // a JSON file; empty: none
    std::string record;                // a new session file; empty: none
    std::string device = "simulated";  // or a wand (app/world/world_wand.hpp)
    std::string points;                // of a wand, that touch; empty: devices::usual_points()
};

// Fails with all problems of the world printed, when it has some.
[[nodiscard]] Result<void> explore_world(const WorldExploration& options);

// Prints that the hand's motion is not as large as the tool's in the world; nothing where it is.
void print_motion_scaled(double scene_from_device_scale);

}  // namespace burin::app
