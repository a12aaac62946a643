// SPDX-License-Identifier: MIT
// The table of all activities that a recording can be of. To add one, enter it in registry.cpp: replay and the tests of
// the documents read that table.
// Pure; any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "session/activity/recorded_activity.hpp"

namespace burin::activities {

struct ActivityKind {
    std::string_view name;  // the first word of Activity::settings()
    std::string_view help;  // one line
    // Makes the activity anew of its settings() and of what its facts() have added to the recording.
    Result<session::MadeActivity> (*make)(const std::string& settings, const session::RecordedFact& fact);
};
[[nodiscard]] std::span<const ActivityKind> activity_kinds();

// Makes the activity of a recording anew; an empty MadeActivity where the settings are empty. Fails on an activity that
// this program does not have, and says which there are.
[[nodiscard]] Result<session::MadeActivity> activity_as_recorded(const std::string& settings,
                                                                 const session::RecordedFact& fact);

}  // namespace burin::activities
