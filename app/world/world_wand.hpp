// SPDX-License-Identifier: MIT
// burin world FILE --stroke STROKE --device simulated-wand[:DESCRIPTION]: a simulated hand explores a world with a
// wand; what each of its points felt of each object goes to the terminal and a report, with a table and plots, and what
// it looked like into pictures.
#pragma once

#include "app/world/world_explore.hpp"
#include "record/compare.hpp"

namespace burin::app {

// Fails with all problems of the world printed, when it has some.
[[nodiscard]] Result<void> explore_world_with_wand(const WorldExploration& options);

// The fact "activity" of a recording of such a stroke.
inline constexpr const char* kWandActivity = "wand stroke";

// Reads what was explored how from the settings of such a recording. Fails where they are unsound.
[[nodiscard]] Result<WorldExploration> recorded_wand_stroke(const record::RecordReader& reader);

// Leads the wand again as a recording's settings say, and compares the ticks in the range. In a difference the first
// value is the recorded one. Where the world or the stroke is another one than was recorded, says so on standard error
// and goes on; another wand is refused. world, stroke: where the files are now; empty: where they were.
[[nodiscard]] Result<record::Comparison> replay_wand(record::RecordReader& reader, const std::string& world,
                                                     const std::string& stroke, const record::TickRange& range);

}  // namespace burin::app
