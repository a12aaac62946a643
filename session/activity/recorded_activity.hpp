// SPDX-License-Identifier: MIT
// An activity that is made anew of what a recording keeps of it: Activity::settings() and Activity::facts(). Plain
// data.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "scene/world_file.hpp"
#include "session/activity/activity.hpp"

namespace burin::session {

// An activity with the scene that it brings along. Null: a session without one; one whose scene comes from files.
struct MadeActivity {
    std::shared_ptr<Activity> activity;
    std::shared_ptr<const scene::World> scene;
};

// Returns a fact of a recording by its name; empty where it has none.
using RecordedFact = std::function<std::string(const std::string& name)>;

}  // namespace burin::session
