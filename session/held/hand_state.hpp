// SPDX-License-Identifier: MIT
// State of one hand of a session: where its workspace is, what it holds, how its force is computed. Plain data.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/space.hpp"
#include "devices/hand/hand_target.hpp"
#include "haptics/workspace/workspace_picture.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::session {

struct HeldHandle;  // session/held/held_handle.hpp
struct HeldTool;    // session/held/held_tool.hpp

// How a hand holds the scene: it turns and moves with the hand from where both were when the hold began.
struct SceneHold {
    Similarity world_from_hand, world_from_scene;
};

struct HandState {
    std::string hand_name;         // "right"; empty for the only hand
    Similarity world_from_device;  // where the hand's workspace is in the world
    toolbox::ToolSettings tool;
    std::shared_ptr<const HeldTool> held;        // of tool.shape, after a step; null only where that cannot be made
    std::shared_ptr<const HeldHandle> handle;    // whose points touch, each as the tool's ball; null: the tool alone
    Pose handle_reads_device, device_from_read;  // where the handle read to be last; its calibration
    haptics::WorkspaceTechnique technique = haptics::WorkspaceTechnique::fixed;
    // Factors a of the exponentially weighted means of force (P11) and velocity; 0: off.
    double force_filter = 0.0, velocity_filter = 0.0;
    double workspace_gain = 1.0;  // multiplies the workspace's gain at home
    bool force_on = true;
    bool catch_drill = false;
    bool only_touch = false;         // the tool feels the surface but leaves it unchanged
    std::optional<SceneHold> holds;  // the scene, in its second button; none: it does not
    devices::HandTarget target;      // where it rests at first, and is led to while another hand is led
    Quat target_turn_device{1.0, 0.0, 0.0, 0.0};
};

}  // namespace burin::session
