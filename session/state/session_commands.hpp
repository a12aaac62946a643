// SPDX-License-Identifier: MIT
// What a command changes of a session. Pure functions; any thread.
#pragma once

#include "base/error.hpp"
#include "session/state/session_command.hpp"

namespace burin::session {

struct CommandInput;   // session/input/command_input.hpp
struct SessionOrders;  // session/state/session_orders.hpp
struct SessionState;   // session/state/session_state.hpp

// Runs a command by its name (command_table.hpp). On an Error, which says what would be right, nothing has changed.
// Commands of a viewer are a Leader's (leader.hpp), and fail here: nobody sees the session.
[[nodiscard]] Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command);
[[nodiscard]] Result<void> run_command(SessionState& state, SessionOrders& orders, const SessionCommand& command);

// Has every part forget what it could have repeated until another part made a step.
void forget_undone(SessionState& state, SessionOrders& orders);

}  // namespace burin::session
