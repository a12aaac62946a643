// SPDX-License-Identifier: MIT
// The desk of a session before its first step: where its viewer is, how mouse and keys lead each hand, and what of the
// picture the panel takes. Thread: the frame's.
#pragma once

#include "desk/viewer/viewer.hpp"
#include "session/options/session_setup.hpp"

namespace burin::session {

// room: of the session's hands (open_room()).
[[nodiscard]] DeskRoom open_desk(const SessionSetup& options, const SessionWall& wall, const Room& room);

// Returns how the main screen is shown at first. Fails on an unknown stereo mode.
[[nodiscard]] Result<wall::OutputSettings> first_output(const SessionWall& wall, const DeskOptions& options);

}  // namespace burin::session
