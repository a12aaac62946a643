// SPDX-License-Identifier: MIT
// The moving algorithm; its table of transitions stands in technique.hpp.
#include "haptics/workspace/turn.hpp"

namespace burin {
namespace {

void recentre(WorkspaceTurn& turn) {
    turn.map() = moved_to(turn.map(), turn.tool_object_m(), turn.settings);
    turn.step.jumped = true;
    enter(turn, WorkspacePhase::jumping);
}

// The tool's offset from the middle is the hand's from the device's.
void drag(WorkspaceTurn& turn) { glide(turn, turn.settings.drag_rate_per_s * turn.input.position_device_m); }

void change_phase(WorkspaceTurn& turn) {
    const WorkspaceState& state = turn.state();
    switch (state.phase) {
        case WorkspacePhase::paused:
            if (turn.went_up) {
                recentre(turn);
            } else if (state.phase_s >= turn.settings.tap_s) {
                enter(turn, WorkspacePhase::dragging);
            }
            break;
        case WorkspacePhase::dragging:
            if (turn.went_up) recentre(turn);
            break;
        case WorkspacePhase::jumping:
            if (turn.went_down) {
                enter(turn, WorkspacePhase::paused);
            } else if (state.phase_s >= turn.settings.series_s) {
                enter(turn, WorkspacePhase::editing);
            }
            break;
        default:
            if (turn.went_down) enter(turn, WorkspacePhase::paused);
            break;
    }
}

}  // namespace

void step_moving(WorkspaceTurn& turn) noexcept {
    change_phase(turn);
    const WorkspacePhase phase = turn.state().phase;
    if (phase == WorkspacePhase::dragging) {
        drag(turn);
    } else {
        turn.state().glide_device_m_per_s = Vec3(0.0);
    }
    turn.step.paused = phase != WorkspacePhase::editing;
    WorkspacePicture& picture = turn.step.picture;
    picture.proposed_visible = phase == WorkspacePhase::paused || phase == WorkspacePhase::dragging;
    picture.proposed_center_object_m = moved_to(turn.map(), turn.tool_object_m(), turn.settings).position_m;
}

}  // namespace burin
