// SPDX-License-Identifier: MIT
// What a wall is in numbers, seen from its fallback head: for burin wall show.
#pragma once

#include <string>

#include "base/json.hpp"
#include "renderer/stereo/wall.hpp"

namespace burin {

// Keys are snake_case with the unit at the end; the same for the same setup.
[[nodiscard]] Json wall_figures(const WallSetup& setup);
// For the terminal, from those figures.
[[nodiscard]] std::string wall_table(const Json& figures);
// Plan and side view of screens, head and comfortable depths, as an SVG picture.
[[nodiscard]] std::string wall_drawing(const WallSetup& setup);

}  // namespace burin
