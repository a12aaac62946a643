// SPDX-License-Identifier: MIT
#include "session/state/leader.hpp"

#include "session/input/input_event.hpp"
#include "session/state/session_commands.hpp"
#include "session/state/session_state.hpp"

namespace burin::session {

Led Leader::lead(const SessionState& state, const Room& /*room*/, std::span<const InputEvent> /*events*/,
                 const StepView& /*view*/) {
    return {.world_from_object = state.world_from_object, .hand = std::nullopt};
}

Result<void> Leader::run(SessionState& state, SessionOrders& orders, const SessionCommand& command) {
    return run_command(state, orders, command);
}

}  // namespace burin::session
