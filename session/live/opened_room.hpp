// SPDX-License-Identifier: MIT
// The room of a session before anything is in it: where the viewer is, and how the desk leads each hand's device, by
// what is known of the devices before they are opened (devices/registry/device_registry.hpp). Thread: the frame's.
#pragma once

#include <memory>
#include <vector>

#include "session/options/session_options.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {

// Returns whether the options name a world, and a workpiece.
[[nodiscard]] bool has_world(const SculptOptions& options);
[[nodiscard]] bool has_workpiece(const SculptOptions& options);

struct OpenedRoom {
    Room room;
    std::vector<std::shared_ptr<const HeldHandle>> handles;  // of each hand; null: a stylus, or one that holds a tool
};

// Fits a room to the devices of all hands and to the panel, and makes the handles ready whose points touch. Fails where
// there is no such device, where its description cannot be read, and where that has not the points.
[[nodiscard]] Result<OpenedRoom> open_room(const SculptOptions& options, const SessionWall& wall);

// Returns how the main screen is shown at first. Fails on an unknown stereo mode.
[[nodiscard]] Result<wall::OutputSettings> first_output(const Room& room, const LiveOptions& live);

}  // namespace burin::session
