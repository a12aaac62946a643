// SPDX-License-Identifier: MIT
// A session that was recorded in real time, once more: every frame as it was, with what the threads had done by then, on one thread and as fast
// as the machine can.
#pragma once

#include "app/sculpt.hpp"
#include "app/session/input_log.hpp"
#include "app/session/session_screens.hpp"

namespace burin {

// The log has threads. Fails at the end, after the last frame, when something came out otherwise than it was recorded: with another
// program, other options, or a log that was changed.
[[nodiscard]] Result<void> replay_as_recorded(const SculptOptions& options, const SessionWall& wall, InputLog log);

}  // namespace burin
