// SPDX-License-Identifier: MIT
// What happens in a session, as rows of its file's table `event`: what hands begin and end to touch. Pure.
#pragma once

#include "session/activity/activity_marks.hpp"

namespace burin::scene {
struct ContactEvent;  // scene/contact_events.hpp
}  // namespace burin::scene

namespace burin::session {

class SessionHands;   // session/hands/session_hands.hpp
struct WorldObjects;  // session/objects/world_objects.hpp

// Returns a contact by names: "touches" or "leaves", of several parts behind the part's ("left index touches"), and the
// object, or "workpiece". world: null: there is none.
[[nodiscard]] EventMark event_of(const scene::ContactEvent& contact, const SessionHands& hands,
                                 const WorldObjects* world);

}  // namespace burin::session
