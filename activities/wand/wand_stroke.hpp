// SPDX-License-Identifier: MIT
// A stroke that explores a world by touch with a wand, and what its recording keeps of it so that it can be done again.
// One thread. Every Error names a file or an option and the remedy.
#pragma once

#include <string>

#include "base/error.hpp"
#include "record/compare.hpp"

namespace burin::activities {

// Options of a stroke that explores a world with a wand.
struct WandStroke {
    std::string world;        // a world.toml or a .wrl (docs/formats.md)
    std::string stroke;       // a CSV file; its button has no meaning here
    std::string device;       // a wand, as --device names it
    std::string points;       // of the wand, that touch; empty: devices::usual_points()
    double radius_m = 0.004;  // of the ball that touches
};

// The fact "activity" of a recording of such a stroke.
inline constexpr const char* kWandActivity = "wand stroke";

// Reads what was explored how from the settings of such a recording. Fails where they are unsound.
[[nodiscard]] Result<WandStroke> recorded_wand_stroke(const record::RecordReader& reader);

// Leads the wand again as a recording's settings say, and compares the ticks in the range. In a difference the first
// value is the recorded one. Where the world or the stroke is another one than was recorded, says so on standard error
// and goes on; another wand is refused. world, stroke: where the files are now; empty: where they were.
[[nodiscard]] Result<record::Comparison> replay_wand(record::RecordReader& reader, const std::string& world,
                                                     const std::string& stroke, const record::TickRange& range);

}  // namespace burin::activities
