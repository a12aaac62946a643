// SPDX-License-Identifier: MIT
// burin profile: runs a session from an input log, in real time with a live session's threads, and shows how long its
// frames and ticks took (desk/timing/session_times.hpp), as a table for the terminal and as JSON.
//   burin profile [--input LOG] [--window] [--driver-threads 0,1,2] [--json OUT]
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "base/error.hpp"
#include "base/json.hpp"
#include "desk/timing/session_times.hpp"

namespace burin::app {

[[nodiscard]] CommandRow profile_row();

// ---- Figures (profile_report.cpp)

struct ProfiledRun {
    std::optional<unsigned> driver_threads;  // of the software driver; none: as many as a live session has
    session::SessionRecord record;
};

// Describes a run: milliseconds unless a name says otherwise; a figure that no frame has is null.
[[nodiscard]] Json describe_run(const ProfiledRun& run);

// Returns a description as a table: frames, stages, ages, ticks, warnings.
[[nodiscard]] std::string profile_table(const Json& run);

// Returns a table with a line for each run, which shows what the number of driver threads changes. Empty for fewer than
// two runs.
[[nodiscard]] std::string comparison_table(const std::vector<Json>& runs);

}  // namespace burin::app
