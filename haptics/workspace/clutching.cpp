// SPDX-License-Identifier: MIT
#include "haptics/workspace/turn.hpp"

namespace burin {

void step_clutching(WorkspaceTurn& turn) noexcept {
    WorkspaceState& state = turn.state();
    if (turn.went_down) {
        enter(turn, WorkspacePhase::clutched);
        state.anchor_object_m = turn.tool_object_m();
    }
    if (turn.went_up) enter(turn, WorkspacePhase::editing);
    if (state.phase != WorkspacePhase::clutched) return;
    // At the reach's border the workspace stops and the tool goes with the hand: all stays continuous.
    const Vec3 arm_object_m = apply_to_vector(turn.map(), turn.input.position_device_m);
    turn.map() = moved_to(turn.map(), state.anchor_object_m - arm_object_m, turn.settings);
    turn.step.paused = true;
}

}  // namespace burin
