// SPDX-License-Identifier: MIT
// What an activity governs (ActivityPanel::governs): tool, objects, workspace and the filters of what is felt. Pure;
// any thread.
#pragma once

#include "session/state/session_state.hpp"

namespace burin::session {

// Puts all that is governed back as it was before the step, whoever asked for something else: a key, the panel, a
// script. Then the orders have a message with the log's line, and none for the scene's parts.
void keep_governed(const SessionState& before, SessionState& state, SessionOrders& orders);

}  // namespace burin::session
