// SPDX-License-Identifier: MIT
// Overlays of a picture: the tool and the haptic workspace, converted from the tool's state to the renderer's scene.
#pragma once

#include <memory>

#include "base/space.hpp"

namespace burin::haptics {
struct ToolState;  // haptics/tool_state.hpp
}  // namespace burin::haptics

namespace burin::picture {
struct Picture;  // picture/picture.hpp
}  // namespace burin::picture

namespace burin::session {

struct HeldTool;  // session/held/held_tool.hpp

// Positions of the tool and of the haptic workspace in the object frame.
struct Staging {
    Vec3 tool_center_object{0.0};
    Quat tool_orientation_object{1.0, 0.0, 0.0, 0.0};
    double tool_radius_object_m = 0.0;     // of a ball, or of one about as wide as the tool
    std::shared_ptr<const HeldTool> held;  // null: a ball
    bool tool_visible = false;
    Similarity object_from_device;
    Vec3 workspace_device_m{0.0};
    bool box_visible = false;
    bool proposed_visible = false;  // box proposed by the moving technique; size and turn as the device's
    Vec3 proposed_center_object{0.0};
    double bubble_radius_object_m = 0.0;  // around the box's center; 0: none
    bool in_contact = false;
    Vec3 contact_object{0.0}, contact_normal_object{0.0};
    Vec3 force_device_N{0.0};    // on the hand
    bool contact_shown = false;  // in contact, draws its ring and its force as an arrow
};

// Returns the tool where it rests on the surface, and what the workspace's technique asks to have shown.
[[nodiscard]] Staging staging_of(const haptics::ToolState& tool, double tool_radius_object_m,
                                 const Vec3& workspace_device_m);

// Adds the overlays to the scene. While a box is proposed the present one is drawn as edges alone, to tell the two
// apart.
void stage(picture::Picture& scene, const Staging& staging, const Similarity& world_from_object);

}  // namespace burin::session
