// SPDX-License-Identifier: MIT
#include "devices/haptic/wand_description.hpp"

#include <algorithm>
#include <cmath>

namespace burin::devices {
namespace {

Quat turn_of(const AxisMap& axes) noexcept {
    glm::dmat3 device_from_maker(0.0);  // by columns: where the maker's axes point
    for (int axis = 0; axis < 3; ++axis)
        device_from_maker[axes.maker[static_cast<std::size_t>(axis)]][axis] = axes.sign[static_cast<std::size_t>(axis)];
    return glm::normalize(glm::quat_cast(device_from_maker));
}

// Limits have no sign.
Vec3 device_limits(const AxisMap& axes, const Vec3& maker) noexcept { return glm::abs(device_axes(axes, maker)); }

}  // namespace

WandDescription quanser_wand_of_maker() {
    WandDescription wand;
    wand.axes = {{0, 2, 1}, {-1.0, 1.0, 1.0}};
    wand.lowest_turn_rad = {-65.0 * kDegree_rad, -85.0 * kDegree_rad, 0.0};
    wand.highest_turn_rad = -wand.lowest_turn_rad;
    wand.max_torque_maker_Nm = {0.230, 0.250, 0.0};
    // Half a turn about the axis between the device's y and z takes the one's axes to the other's.
    wand.scene_from_maker = {{0.0, 0.2, -0.2}, Quat(0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5))};
    wand.calibration.maker_from_handle = {{0.0, 0.124, 0.0}, Quat(1.0, 0.0, 0.0, 0.0)};
    return wand;
}

Vec3 device_axes(const AxisMap& axes, const Vec3& maker) noexcept {
    return {axes.sign[0] * maker[axes.maker[0]], axes.sign[1] * maker[axes.maker[1]],
            axes.sign[2] * maker[axes.maker[2]]};
}

Pose device_from_maker(const WandDescription& wand) noexcept {
    return {-device_axes(wand.axes, wand.workspace_maker_m.center()), turn_of(wand.axes)};
}

Similarity scene_from_device(const WandDescription& wand) noexcept {
    const Quat maker_turn = glm::conjugate(turn_of(wand.axes));
    const Pose& scene = wand.scene_from_maker;
    return {scene.position_m + wand.gain * (scene.orientation * wand.workspace_maker_m.center()),
            scene.orientation * maker_turn, wand.gain};
}

Vec3 offset_device_m(const WandDescription& wand, const WandPoint& point) noexcept {
    return wand.device_tool_from_handle * point.offset_m;
}

DeviceDescription device_of(const WandDescription& wand) noexcept {
    DeviceDescription device;
    device.name = wand.name.c_str();
    device.workspace_m = device_limits(wand.axes, wand.workspace_maker_m.extent());
    device.resolution_m = wand.arm.resolution_m;
    device.axis_max_force_N = device_limits(wand.axes, wand.max_force_maker_N);
    // Each axis has a limit of its own: the length of all three together is none besides them.
    device.max_force_N = glm::length(device.axis_max_force_N);
    device.max_torque_Nm = device_limits(wand.axes, wand.max_torque_maker_Nm);
    device.max_stiffness_N_per_m = wand.arm.max_stiffness_N_per_m;
    device.rate_Hz = wand.rate_Hz;
    device.apparent_mass_kg = wand.arm.mass_kg;
    device.damping_Ns_per_m = wand.arm.damping_Ns_per_m;
    device.friction_N = wand.arm.friction_N;
    device.delay_s = wand.arm.delay_s;
    device.max_torsion_Nm_per_rad = wand.arm.max_torsion_Nm_per_rad;
    device.apparent_inertia_kgm2 = wand.arm.inertia_kgm2;
    device.angular_damping_Nms_per_rad = wand.arm.angular_damping_Nms_per_rad;
    device.angular_friction_Nm = wand.arm.angular_friction_Nm;
    device.orientation_step_rad = wand.arm.orientation_step_rad;
    const Vec3 one_way = device_axes(wand.axes, wand.lowest_turn_rad);
    const Vec3 other_way = device_axes(wand.axes, wand.highest_turn_rad);
    device.lowest_turn_rad = glm::min(one_way, other_way);
    device.highest_turn_rad = glm::max(one_way, other_way);
    return device;
}

Pose jig_pose_device(const WandDescription& wand) noexcept {
    const Pose to_device = device_from_maker(wand);
    const Pose& jig = wand.calibration.maker_from_handle;
    // The handle's axes are the device's where it is not turned, so the jig's turn is taken into these.
    return {to_device * jig.position_m,
            to_device.orientation * jig.orientation * glm::conjugate(to_device.orientation)};
}

CalibrationError calibration_error(const WandDescription& wand, const Pose& device_from_handle) noexcept {
    const Pose jig = jig_pose_device(wand);
    CalibrationError error;
    error.distance_m = glm::length(device_from_handle.position_m - jig.position_m);
    const Quat between = glm::conjugate(jig.orientation) * device_from_handle.orientation;
    error.angle_rad = 2.0 * std::atan2(glm::length(Vec3(between.x, between.y, between.z)), std::abs(between.w));
    error.within_tolerance =
        error.distance_m <= wand.calibration.tolerance_m && error.angle_rad <= wand.calibration.tolerance_rad;
    return error;
}

}  // namespace burin::devices
