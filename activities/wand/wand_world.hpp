// SPDX-License-Identifier: MIT
// The world that a wand's stroke (activities/wand/wand_stroke.hpp) explores, and what it is felt with.
// One thread. Every Error names a file or an option and the remedy.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/wand/felt_wand.hpp"
#include "base/error.hpp"

namespace burin::activities {

struct WandStroke;  // activities/wand/wand_stroke.hpp

// All that a stroke with a wand is felt with.
struct WandWorld {
    WandOptions feel;
    sculpt::Stroke stroke;
    ExploredWorld world;
    std::string digest;
};

// Fails with all problems of the world printed, when it has some, and where the device has no handle with points.
[[nodiscard]] Result<std::unique_ptr<WandWorld>> open_wand_world(const WandStroke& options);

// Returns what a recording of the stroke says of the program and of what was explored. `facts`: of the program.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> facts_of_wand(
    const WandStroke& options, const WandWorld& opened, std::vector<std::pair<std::string, std::string>> facts);

}  // namespace burin::activities
