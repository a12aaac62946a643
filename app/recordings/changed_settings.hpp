// SPDX-License-Identifier: MIT
// Changes options of a recorded session, OPTION=VALUE, to what they take on the command line of burin sculpt: names of
// assets, words and bounds. The words are read by that command line itself. May look for files. One thread.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

struct ChangedSettings {
    std::string settings;           // of the recording's first line, with all changes
    session::SessionSetup options;  // with those of a session that no recording keeps, such as --shadows
    bool another_view = false;      // what is seen has changed, and from where
};
// A flag takes on and off; no value at all leaves an option out. Fails on what the command line refuses, and on options
// of the recording's activity, whose course they are.
[[nodiscard]] Result<ChangedSettings> with_changes(std::string settings, const std::vector<std::string>& changes,
                                                   const session::SessionSetup& given);

}  // namespace burin::app
