// SPDX-License-Identifier: MIT
// The options that a session's frames depend on, as the line that a recording begins with: "burin sculpt --workpiece ball:0.1 ...", which can
// be given to a shell as well. Not among them: what only says where and how fast it runs (engine, threads, display, files). Pure.
#pragma once

#include <string>
#include <vector>

#include "app/sculpt.hpp"

namespace burin {

[[nodiscard]] std::string settings_line(const SculptOptions& options);

// The options of a recording's line, and as before what is not on such lines. An Error names an option that is unknown or wrong.
struct RecordedOptions {
    SculptOptions options;
    std::vector<std::string> overruled;  // that were given and say otherwise than the recording: one message each
};
[[nodiscard]] Result<RecordedOptions> options_as_recorded(const std::string& line, const SculptOptions& given);

}  // namespace burin
