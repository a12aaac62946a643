// SPDX-License-Identifier: MIT
// Reads from a recording its session's activity and the files that the session was made from. No output may be written
// over those files, since the recording could not be done again without them. Any thread.
#pragma once

#include <string>
#include <vector>

#include "session/options/session_setup.hpp"

namespace burin::app {

// Returns the files that a recording names, a session file or a text log: world, workpiece, stroke, wall, and the files
// of a tool and a device, with all that these read; for a session file also those that SQLite keeps beside it. Names
// are as they were recorded, so relative to where that was. Nothing for a file that is no recording.
[[nodiscard]] std::vector<std::string> files_named_by(const std::string& recording);

// Returns the settings of the activity (session::Activity::settings()) of a recording that is done again: of --input,
// where nothing is recorded besides. Empty where that is no recording, or one without an activity.
[[nodiscard]] std::string repeated_activity(const session::SessionSetup& setup);
// Takes the defaults of an activity's command out of its session, which stand for nothing that its user has said: what
// is done again has its own. Without it the user was told that they do not count. `world_given`: by the user.
void leave_to_recording(session::SessionSetup& options, bool world_given);

}  // namespace burin::app
