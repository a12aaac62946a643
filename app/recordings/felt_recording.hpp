// SPDX-License-Identifier: MIT
// What a recording of a felt stroke (burin sculpt --stroke FILE --hand simulated --record) keeps so that it can be done
// again, and doing it again: the stroke is carved once more with the settings in the file, into a recording in a
// temporary folder, and that is compared with the one that is there.
#pragma once

#include <optional>
#include <string>

#include "compute/engine/chosen_engine.hpp"
#include "record/compare.hpp"
#include "sculpt/load_workpiece.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

// The fact "activity" of such a recording.
inline constexpr const char* kFeltActivity = "felt stroke";

// Returns the settings as JSON, for the fact "settings": all options that decide what is felt. `engine` is the one that
// was chosen, `tool` the one that was taken where none was given.
[[nodiscard]] std::string felt_settings(const session::SessionSetup& options, const toolbox::ToolOptions& tool,
                                        const std::string& engine);
// Reads what felt_settings() has written; `where` names the file.
[[nodiscard]] Result<session::SessionSetup> read_felt_settings(const std::string& text, const std::string& where);
// Returns the radius of a ball that carved; none: the settings are unsound, or the tool was another.
[[nodiscard]] std::optional<double> felt_ball_radius_m(const std::string& settings);

// Where the files of a recording are now; empty: where they were.
struct FeltFiles {
    std::string stroke, workpiece;
    std::optional<compute::EngineChoice> engine;  // instead of the recorded one; either gives the same ticks
};

// Carves the stroke again and compares the ticks in the range. In a difference the first value is the recorded one.
// Fails where a file is missing or another one than was recorded, and for a stroke that was felt in real time.
[[nodiscard]] Result<record::Comparison> replay_felt(record::RecordReader& reader, const FeltFiles& files,
                                                     const record::TickRange& range);

// Carves the stroke of the options by feel and records it, and nothing else (app/carve/sculpt.cpp).
[[nodiscard]] Result<void> record_again(const session::SessionSetup& options);

}  // namespace burin::app
