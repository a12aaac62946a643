// SPDX-License-Identifier: MIT
// A stroke that explores a world by touch with a wand, and what older recordings keep of it.
// One thread. Every Error names a file or an option and the remedy.
#pragma once

#include <string>

#include "base/error.hpp"
#include "record/record_reader.hpp"

namespace burin::activities {

// Options of a stroke that explores a world with a wand.
struct WandStroke {
    std::string world;        // a world.toml or a .wrl (docs/formats.md)
    std::string stroke;       // a CSV file; its button has no meaning here
    std::string device;       // a wand, as --device names it
    std::string points;       // of the wand, that touch; empty: devices::usual_points()
    double radius_m = 0.004;  // of the ball that touches
};

// The fact "activity" of a recording of such a stroke, from before it was a session.
inline constexpr const char* kWandActivity = "wand stroke";

// Reads what was explored how from the settings of such a recording. Fails where they are unsound.
[[nodiscard]] Result<WandStroke> recorded_wand_stroke(const record::RecordReader& reader);

}  // namespace burin::activities
