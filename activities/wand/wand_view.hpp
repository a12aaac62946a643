// SPDX-License-Identifier: MIT
// Draws a wand in a world (session/held/held_handle.hpp has what is drawn of it), seen from nearby. Frames: as
// activities/world/world_view.hpp. Pure; any thread.
#pragma once

#include <vector>

#include "activities/world/world_view.hpp"
#include "session/held/held_handle.hpp"

namespace burin::activities {

// What is drawn of a wand. Lengths are those of the scene.
struct WandPose {
    Pose scene_from_tool;            // of the handle, as devices::offset_device_m counts
    std::vector<Vec3> points_scene;  // the balls' middles: where they touch
    Vec3 force_N{0.0};               // on the hand, in the scene's axes; an arrow from the handle's middle
};

struct WandCamera {
    Vec3 towards_eye{0.25, 0.75, 1.0};  // in the scene, any length
    Vec3 middle_scene{0.0};             // of the picture
    double half_height_m = 0.1;         // of the picture, in the scene
};

class WandView {
public:
    // The balls' radius is that which touches, in the scene.
    WandView(const devices::WandDescription& wand, double scale, double radius_m);

    // Adds the wand to a picture of the world.
    void add_to(picture::Picture& scene, const WandPose& pose, const Similarity& world_from_scene) const;
    // Returns the world with the wand, from nearby.
    [[nodiscard]] picture::Picture close_scene(const WorldView& world, const WandPose& pose,
                                               const WandCamera& camera) const;

private:
    session::DrawnHandle drawn_;
    double scale_;
    double radius_m_;
};

}  // namespace burin::activities
