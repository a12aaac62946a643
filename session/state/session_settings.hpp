// SPDX-License-Identifier: MIT
// Formats the options that a session's frames depend on as the first line of a recording: "burin sculpt --workpiece
// ball:0.1 ...", which a shell takes as well. Leaves out what only sets where and how fast a session runs (engine,
// threads, display, files). What the command line left open, the workpiece's unit and the tool, has to be settled first
// (Session::settled), so that a replay does not guess. Pure.
#pragma once

#include <string>
#include <vector>

#include "session/options/session_setup.hpp"

namespace burin::session {

// Returns the settings within a recording's first line, from the command on; empty where there are none.
[[nodiscard]] std::string settings_on(const std::string& header);
[[nodiscard]] std::string settings_line(const SessionSetup& options);
// Returns what stands behind an option ("--device") of a recording's line; empty where it is not there, or is a flag.
[[nodiscard]] Result<std::string> option_on(const std::string& line, const std::string& option);
// Returns the devices of all hands of a recording's line, the only hand's without a name.
[[nodiscard]] Result<std::vector<NamedDevice>> hands_on(const std::string& line);
// Returns the settings of the activity of a recording's line (Activity::settings()); empty where it had none.
[[nodiscard]] Result<std::string> activity_on(const std::string& line);

// Returns the names of all options that such lines may hold, "--world" first; the activity is none.
[[nodiscard]] std::vector<std::string> setting_names();
// Returns the line with one of those options as `from` has it, last; without it where `from` leaves it out.
[[nodiscard]] Result<std::string> with_setting_of(const SessionSetup& from, const std::string& option,
                                                  const std::string& line);

// Checks that a recording's line is of the given activity; null: of none. The Error names the command that recorded it.
[[nodiscard]] Result<void> check_activity_on(const std::string& line, const Activity* given);

// Reads the options of a recording's line; options that such lines never hold keep their given values. A recording
// without a unit is read in metres, as it was made. The Error names an option that is unknown or wrong, or says that
// the recording is of another activity than the given one.
struct RecordedOptions {
    SessionSetup options;
    std::vector<std::string> overruled;  // a message for each given option that the recording contradicts
};
[[nodiscard]] Result<RecordedOptions> options_as_recorded(const std::string& line, const SessionSetup& given);

}  // namespace burin::session
