// SPDX-License-Identifier: MIT
// What an activity governs (ActivityPanel::governs): all that the person feels and sees but for where the head and the
// hand are. Force, tool, objects, workspace, where the scene and the device stand, filters, and how it is shown. Eye
// distance is the viewer's own, and amplifiers can always be switched off: they are the way to rest a device, and the
// ticks tell of it. Pure; any thread.
#pragma once

#include <string_view>

#include "session/state/session_state.hpp"

namespace burin::session {

inline constexpr std::string_view kGovernedMessage =
    "force, view, tool, objects and workspace are the activity's, and stay as they are";

// Puts all that is governed back as it was before the step, whoever asked for something else: a key, the panel, a
// script, a hand that turns the scene. Then the orders have a message with the log's line, and none for the scene's
// parts. viewer_changed: the leader has put something of its own back (Leader::keep_governed()).
void keep_governed(const SessionState& before, SessionState& state, SessionOrders& orders, bool viewer_changed);
// The same for a user who was told `newest` last: a hand that goes on turning the scene is told once that it stays.
void keep_governed(const SessionState& before, SessionState& state, SessionOrders& orders, bool viewer_changed,
                   std::string_view newest);

}  // namespace burin::session
