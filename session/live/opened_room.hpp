// SPDX-License-Identifier: MIT
// The room of a session before anything is in it: how far each hand reaches and how it rests, by what is known of the
// devices before they are opened (devices/registry/device_registry.hpp). Thread: the frame's.
#pragma once

#include <memory>
#include <vector>

#include "session/options/session_setup.hpp"
#include "session/state/session_room.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {

struct OpenedRoom {
    Room room;
    std::vector<std::shared_ptr<const HeldHandle>> handles;  // of each hand; null: a stylus, or one that holds a tool
};

// Fits a room to the devices of all hands, and makes the handles ready whose points touch. Fails where there is no such
// device, where its description cannot be read, and where that has not the points.
[[nodiscard]] Result<OpenedRoom> open_room(const SessionSetup& options);

}  // namespace burin::session
