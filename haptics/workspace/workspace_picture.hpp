// SPDX-License-Identifier: MIT
// Which workspace technique there is, in which phase it is, and what a frame draws of it. The techniques themselves are
// explained in haptics/workspace/technique.hpp.
// Frame: object. Plain data.
#pragma once

#include <cstdint>

#include "base/space.hpp"

namespace burin::haptics {

enum class WorkspaceTechnique : std::uint8_t { fixed, moving, scaling, clutching, bubble, drift };

[[nodiscard]] const char* text(WorkspaceTechnique technique) noexcept;

enum class WorkspacePhase : std::uint8_t {
    editing,   // the tool works
    paused,    // the button is down: the box shows where the workspace will be
    dragging,  // the workspace follows the tool
    jumping,   // between presses of a series
    clutched,  // the scene's tool stays, the hand returns
    gliding,   // rate control beyond the bubble
};

[[nodiscard]] const char* text(WorkspacePhase phase) noexcept;

// What the frame draws of the workspace, in the object frame.
struct WorkspacePicture {
    WorkspacePhase phase = WorkspacePhase::editing;
    Similarity object_from_device;  // present location of the device's box
    // The transparent box of the moving algorithm, turned and as large as the device's.
    bool proposed_visible = false;
    Vec3 proposed_center_object_m{0.0};
    double bubble_radius_object_m = 0.0;  // around the box's middle; 0: none
};

}  // namespace burin::haptics
