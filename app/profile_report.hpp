// SPDX-License-Identifier: MIT
// The figures of sessions that were timed (app/session/session_times.hpp), as a table for the terminal and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/session_times.hpp"
#include "base/json.hpp"

namespace burin {

struct ProfiledRun {
    std::optional<unsigned> driver_threads;  // of the software driver; nothing: as a live session has it
    SessionRecord record;
};

// Milliseconds but where a name says otherwise; a figure that no frame has is null.
[[nodiscard]] Json describe_run(const ProfiledRun& run);

// From one description: frames, stages, ages, ticks, warnings.
[[nodiscard]] std::string profile_table(const Json& run);
// A line a run, of what the driver's threads change. Empty for less than two.
[[nodiscard]] std::string comparison_table(const std::vector<Json>& runs);

}  // namespace burin
