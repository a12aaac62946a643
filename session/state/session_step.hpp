// SPDX-License-Identifier: MIT
// One step of a session, as a function of its state (session/state/session_state.hpp), of what comes in and of who
// leads it. No clock, thread or viewer.
#pragma once

#include <cstddef>
#include <span>

#include "base/error.hpp"
#include "session/state/leader.hpp"
#include "session/state/session_orders.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {

// Runs a command by its name.
[[nodiscard]] Result<void> run_command(SessionState& state, SessionOrders& orders, const CommandInput& command,
                                       Leader& leader);

struct SessionStep {
    SessionState state;
    SessionOrders orders;
    std::size_t led_hand = 0;  // the hand in use when the step began
    Led led;
};
// Goes on by one step: the leader, the events' commands, and hands that hold the scene.
[[nodiscard]] SessionStep step_session(SessionState state, const Room& room, std::span<const InputEvent> events,
                                       const StepView& view, Leader& leader);

// Has the tool smooth from the press of a stroke that is to smooth until all of it has been carved.
[[nodiscard]] Result<void> follow_smooth_stroke(SessionState& state, SessionOrders& orders, const Led& led,
                                                const StepView& view);

}  // namespace burin::session
