// SPDX-License-Identifier: MIT
// The table of all activities that a recording can be of. To add one, enter it in registry.cpp: replay and the tests of
// the documents read that table.
// Pure; any thread.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "scene/world_file.hpp"
#include "session/state/activity.hpp"

namespace burin::activities {

// An activity with the scene that it brings along. Null: a session without one; one whose scene comes from files.
struct MadeActivity {
    std::shared_ptr<session::Activity> activity;
    std::shared_ptr<const scene::World> scene;
};

// Returns a fact of a recording by its name; empty where it has none.
using RecordedFact = std::function<std::string(const std::string& name)>;

struct ActivityKind {
    std::string_view name;  // the first word of Activity::settings()
    std::string_view help;  // one line
    // Makes the activity anew of its settings() and of what its facts() have added to the recording.
    Result<MadeActivity> (*make)(const std::string& settings, const RecordedFact& fact);
};
[[nodiscard]] std::span<const ActivityKind> activity_kinds();

// Makes the activity of a recording anew; an empty MadeActivity where the settings are empty. Fails on an activity that
// this program does not have, and says which there are.
[[nodiscard]] Result<MadeActivity> activity_as_recorded(const std::string& settings, const RecordedFact& fact);

}  // namespace burin::activities
