// SPDX-License-Identifier: MIT
// What a picture shows of the tool and of the haptic workspace: from the tool's state to the renderer's scene.
#pragma once

#include "haptics/channels.hpp"
#include "renderer/scene.hpp"

namespace burin {

// Where tool and haptic workspace stand, in the object frame.
struct Staging {
    Vec3 tool_center_object{0.0};
    double tool_radius_object_m = 0.0;
    bool tool_visible = false;
    Similarity object_from_device;
    Vec3 workspace_device_m{0.0};
    bool box_visible = false;
    bool proposed_visible = false;  // the moving algorithm's transparent box: as large and as turned as the device's
    Vec3 proposed_center_object{0.0};
    double bubble_radius_object_m = 0.0;  // around the box's middle; 0: none
    bool in_contact = false;
    Vec3 contact_object{0.0}, contact_normal_object{0.0};
    Vec3 force_device_N{0.0};    // on the hand
    bool contact_shown = false;  // while in contact: its ring and its force as an arrow
};

// The tool where it rests on the surface, and all that the workspace's technique wants shown.
[[nodiscard]] Staging staging_of(const ToolState& tool, double tool_radius_object_m, const Vec3& workspace_device_m);

// Puts it into the scene. While a box is proposed the present one is drawn as its edges alone, so that the two are told apart.
void stage(Scene& scene, const Staging& staging, const Similarity& world_from_object);

}  // namespace burin
