// SPDX-License-Identifier: MIT
// Makes what a session's hands are to touch, of a document, a file or a shape, and takes from it what the options
// leave open. Thread: the frame's.
#pragma once

#include <memory>

#include "session/live/hand_side.hpp"
#include "session/live/work_side.hpp"
#include "session/live/world_side.hpp"
#include "session/options/session_setup.hpp"
#include "session/state/session_state.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {

// Takes the workpiece of a document, or makes it of a file or a shape. Fails where a device is to carve and the options
// have no maker of its engine, and where they have none of a workpiece.
[[nodiscard]] Result<std::unique_ptr<workpiece::Workpiece>> make_workpiece(const SessionSetup& options,
                                                                           OpenedWork& opened);
// Takes its place into the room, and what was found out of it.
void note_workpiece(const workpiece::Workpiece& made, const SessionSetup& options, Room& room, FoundOut& found);

// Takes the world of a document, or reads it.
[[nodiscard]] Result<std::unique_ptr<WorldSide>> open_world(const SessionSetup& options, OpenedWork& opened);
[[nodiscard]] inline bool is_world_saved(const OpenedWork& opened) {
    return opened.world.has_value() && opened.journal.empty() && opened.lost.empty();
}
// Likewise, once there is the workpiece, if there is any.
void note_world(const WorldSide& world, const SessionSetup& options, Room& room, FoundOut& found);

// Chooses a tool of the size of what there is, where none is given.
void note_tool(const SessionSetup& options, const Room& room, FoundOut& found);

// Returns what is there before anything is touched. placed: where the workpiece stands in the world.
[[nodiscard]] Result<SessionState> first_state(const SessionSetup& options, const FoundOut& found, const Room& room,
                                               const HandSide::Handles& handles, const Similarity& placed);

}  // namespace burin::session
