// SPDX-License-Identifier: MIT
// The handle in the hand of a session, in place of a stylus, of a device that has one with points of its own (a wand):
// which of them touch, and how it is drawn. The tool that is held says how large the ball at each point is; it carves
// with the first of them. The wands of a tracker, which feel nothing, are others (desk/input/input_wand.hpp).
//
// Frames: as devices/haptic/wand_description.hpp; the handle's own frame may stand elsewhere than the device's. Made
// once when the session begins, immutable and shared; any thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "devices/haptic/wand_description.hpp"

namespace burin::haptics {
struct TickParameters;  // haptics/tick_parameters.hpp
struct ToolState;       // haptics/tool_state.hpp
}  // namespace burin::haptics

namespace burin::picture {
struct DrawnMesh;    // picture/drawn_mesh.hpp
struct DrawnObject;  // picture/picture.hpp
struct Picture;
}  // namespace burin::picture

namespace burin::session {

// What pictures show of a handle: a thin cylinder that follows the handle, and a ball at each point that touches: red
// at the first, green at the last, blue between them. One point alone is red.
class DrawnHandle {
public:
    explicit DrawnHandle(const devices::WandDescription& description);

    // Where it is. Its points are where they rest on surfaces, not beyond them.
    struct Place {
        Similarity world_from_tool;  // of the device's tool; its scale is that of lengths at the device
        std::vector<Vec3> points_world;
        double radius_m = 0.0;  // of the balls, in the world
    };
    void add_to(std::vector<picture::DrawnObject>& objects, const Place& place) const;

private:
    std::shared_ptr<const picture::DrawnMesh> rod_, ball_;  // the ball's radius is a metre
    Pose tool_from_handle_;
    double half_length_m_;
};

struct HeldHandle {
    HeldHandle(devices::WandDescription described, std::vector<devices::WandPoint> touching);

    devices::WandDescription description;
    std::vector<devices::WandPoint> points;  // 1 to devices::kMostWandPoints
    DrawnHandle drawn;

    // Gives a tick the handle's probe, with a ball of this radius at each point, and the limits of its device.
    void write(haptics::TickParameters& parameters, double radius_m) const;
    // Returns how far the farthest point is from the first, at the device.
    [[nodiscard]] double spread_m() const;
    // Returns where the first point is, of a handle held in a pose of its device.
    [[nodiscard]] Vec3 first_point_device(const Pose& pose_device) const;
    // Returns the turn from the scene's axes into the device's, and where in the device the scene's front (+Z) is.
    [[nodiscard]] Quat device_from_scene_turn() const;
    [[nodiscard]] Vec3 front_device() const { return device_from_scene_turn() * Vec3(0.0, 0.0, 1.0); }
};

// Returns where the device's workspace is in a scene: where the description has it, if it meets there what is touched;
// else around that, and large enough to cover it.
[[nodiscard]] Similarity object_from_device(const HeldHandle& held, const Box& touched_object);

// Calibration: what the device reads is taken through a motion, so that the pose it reads in the jig is the jig's.
struct HandleCalibrated {
    Pose device_from_read;
    std::string message;  // how far off it was
};
// Fails where the handle reads farther off than the description allows: then it is not in the jig, or its encoders have
// lost their place.
[[nodiscard]] Result<HandleCalibrated> calibrated(const devices::WandDescription& description, const Pose& read_device);

// Adds the handle to a picture, where the tick has it.
void add_handle(picture::Picture& scene, const HeldHandle& held, const haptics::ToolState& tool, double radius_object_m,
                const Similarity& world_from_object);

}  // namespace burin::session
