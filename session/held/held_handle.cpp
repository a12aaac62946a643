// SPDX-License-Identifier: MIT
#include "session/held/held_handle.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "haptics/contact/probe.hpp"
#include "haptics/tick_parameters.hpp"
#include "haptics/tool_state.hpp"
#include "picture/frame_setup.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::session {
namespace {

static_assert(devices::kMostWandPoints <= haptics::kMostProbePoints);

constexpr double kRodRadius = 0.02;  // as a share of the handle's length
const Vec3 kRodColour{0.75, 0.76, 0.80}, kTopBall{0.86, 0.12, 0.10}, kBottomBall{0.10, 0.68, 0.22},
    kOtherBall{0.20, 0.40, 0.85};

}  // namespace

DrawnHandle::DrawnHandle(const devices::WandDescription& description)
    : rod_(picture::drawn_mesh(
          toolbox::drawing_of(compute::CylinderTool{kRodRadius * description.handle_m, description.handle_m}))),
      ball_(picture::drawn_mesh(toolbox::drawing_of(compute::BallTool{1.0}))),
      tool_from_handle_(description.device_tool_from_handle),
      half_length_m_(0.5 * description.handle_m) {}

void DrawnHandle::add_to(std::vector<picture::DrawnObject>& objects, const Place& place) const {
    // A cylinder stands on its origin.
    const Similarity tool_from_rod = Similarity{tool_from_handle_.position_m, tool_from_handle_.orientation, 1.0} *
                                     Similarity{{0.0, -half_length_m_, 0.0}, {1.0, 0.0, 0.0, 0.0}, 1.0};
    objects.push_back({rod_, place.world_from_tool * tool_from_rod, kRodColour});
    for (std::size_t i = 0; i < place.points_world.size(); ++i) {
        const bool is_last = i + 1 == place.points_world.size();
        const Vec3& colour = i == 0 ? kTopBall : (is_last ? kBottomBall : kOtherBall);
        objects.push_back({ball_, {place.points_world[i], {1.0, 0.0, 0.0, 0.0}, place.radius_m}, colour});
    }
}

HeldHandle::HeldHandle(devices::WandDescription described, std::vector<devices::WandPoint> touching)
    : description(std::move(described)), points(std::move(touching)), drawn(description) {}

void HeldHandle::write(haptics::TickParameters& parameters, double radius_m) const {
    haptics::Probe& probe = parameters.probe;
    probe.count = static_cast<std::uint32_t>(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        probe.points[i] = {devices::offset_device_m(description, points[i]), radius_m};
    const devices::DeviceDescription device = devices::device_of(description);
    parameters.position_noise_m = device.resolution_m;
    parameters.limits.max_force_N = device.max_force_N;
}

double HeldHandle::spread_m() const {
    double farthest_m = 0.0;
    for (const devices::WandPoint& point : points)
        farthest_m = std::max(farthest_m, glm::length(point.offset_m - points.front().offset_m));
    return farthest_m;
}

Vec3 HeldHandle::first_point_device(const Pose& pose_device) const {
    return pose_device * devices::offset_device_m(description, points.front());
}

Quat HeldHandle::device_from_scene_turn() const {
    return glm::conjugate(devices::scene_from_device(description).orientation);
}

Similarity object_from_device(const HeldHandle& held, const Box& touched_object) {
    constexpr double kCovers = 1.1;  // of what is touched, where the description does not say
    const Similarity described = devices::scene_from_device(held.description);
    const Vec3 half = 0.5 * devices::device_of(held.description).workspace_m;
    const Box reached = picture::placed_box({-half, half}, described);
    const Vec3 overlap = glm::min(reached.hi, touched_object.hi) - glm::max(reached.lo, touched_object.lo);
    if (std::min({overlap.x, overlap.y, overlap.z}) >= 0.0) return described;
    const Vec3 needed = kCovers * touched_object.extent() / (reached.extent() / described.scale);
    return {touched_object.center(), described.orientation, std::max({needed.x, needed.y, needed.z})};
}

Result<HandleCalibrated> calibrated(const devices::WandDescription& description, const Pose& read_device) {
    const devices::CalibrationError error = devices::calibration_error(description, read_device);
    const std::string off = formatted("%.1f mm and %.2f degrees off the jig's pose", 1e3 * error.distance_m,
                                      error.angle_rad / devices::kDegree_rad);
    if (!error.within_tolerance) {
        const Vec3& jig_m = description.calibration.maker_from_handle.position_m;
        return fail("calibrate",
                    "the wand reads " + off +
                        formatted(", where at most %.1f mm and %.2f degrees are allowed",
                                  1e3 * description.calibration.tolerance_m,
                                  description.calibration.tolerance_rad / devices::kDegree_rad),
                    formatted("put it into the jig, which is at %g, %g, %g m in the maker's frame, and calibrate "
                              "again; if it is there, switch the device off and on in the jig",
                              jig_m.x, jig_m.y, jig_m.z));
    }
    const Pose jig = devices::jig_pose_device(description);
    const Similarity device_from_read = Similarity{jig.position_m, jig.orientation, 1.0} *
                                        inverse(Similarity{read_device.position_m, read_device.orientation, 1.0});
    return HandleCalibrated{{device_from_read.position_m, glm::normalize(device_from_read.orientation)},
                            "calibrated: the wand read " + off};
}

void add_handle(picture::Picture& scene, const HeldHandle& held, const haptics::ToolState& tool, double radius_object_m,
                const Similarity& world_from_object) {
    if (tool.tick == 0) return;
    const Similarity& object_from_device = tool.workspace.object_from_device;
    const Similarity object_from_tool{object_from_device * tool.position_device_m, tool.orientation_object,
                                      object_from_device.scale};
    DrawnHandle::Place place{world_from_object * object_from_tool, {}, world_from_object.scale * radius_object_m};
    for (std::uint32_t i = 0; i < tool.point_count; ++i)
        place.points_world.push_back(world_from_object * tool.proxies_object_m[i]);
    held.drawn.add_to(scene.objects, place);
}

}  // namespace burin::session
