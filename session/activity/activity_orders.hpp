// SPDX-License-Identifier: MIT
// What an activity (session/activity/activity.hpp) wants done after a step. Plain data.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/contact_events.hpp"
#include "session/activity/activity_marks.hpp"
#include "session/objects/edit_object.hpp"

namespace burin::session {

using scene::PartOfHand;

// Has parts of hands take hold of an object: from the scene's next update on it moves with the frame of them all
// (scene::grip_frame()), from where it and they are then. A hold that there was gives way. By nobody: lets go of it,
// and it stays fixed where it was.
struct HoldObject {
    std::string object;
    std::vector<PartOfHand> by;
    bool felt = false;  // by the parts that hold it (scene::HeldMotion)
    bool operator==(const HoldObject&) const = default;
};

// What it wants done; filled in order.
struct ActivityOrders {
    std::vector<EditObject> edits;
    std::vector<HoldObject> holds;
    std::vector<std::string> messages;     // for the user, on panel and terminal
    std::vector<std::string> screenshots;  // names
    std::vector<TrialMark> trials;         // kept where a session file is recorded
    // Done on the scene's thread before its next update, in order: what its own part of the scene is told. Whatever a
    // function refers to must outlive the session.
    std::vector<std::function<void()>> on_scene;
    bool parameters = false;  // adjust() has changed
    bool quit = false;
};

}  // namespace burin::session
