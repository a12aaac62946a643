// SPDX-License-Identifier: MIT
// What a command line says of a wand: its name, and which of its points touch. Threads: any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "devices/haptic/wand_description.hpp"

namespace burin::devices {

inline constexpr std::string_view kSimulatedWand = "simulated-wand";

// Returns the points that a text names: names of the description's with commas between them, "centre" for the handle's
// origin, or a number of points evenly from the first to the last of the description's. Fails with the nearest name.
[[nodiscard]] Result<std::vector<WandPoint>> points_named(const WandDescription& wand, const std::string& text);

// The ends of the Quanser wand.
inline constexpr const char* kUsualPoints = "top,bottom";
// Returns what touches where nothing is said, as points_named() reads it: top and bottom where the description has
// both, else all of its points; the middle where it has none.
[[nodiscard]] std::string usual_points(const WandDescription& wand);

}  // namespace burin::devices
