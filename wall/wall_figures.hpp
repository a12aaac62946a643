// SPDX-License-Identifier: MIT
// Figures, table and drawing of a wall as seen from its fallback head, for burin wall show.
#pragma once

#include <string>

#include "base/json.hpp"
#include "wall/wall.hpp"

namespace burin::wall {

// Figures of a wall. Keys are snake_case with the unit at the end; the same setup gives the same figures.
[[nodiscard]] Json wall_figures(const WallSetup& setup);
// The figures as text for the terminal.
[[nodiscard]] std::string wall_table(const Json& figures);
// A plan and a side view of screens, head and comfortable depths, as an SVG picture.
[[nodiscard]] std::string wall_drawing(const WallSetup& setup);

}  // namespace burin::wall
