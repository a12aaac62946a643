// SPDX-License-Identifier: MIT
// The joints of a device, as plain data, and what follows from their encoders for the handle.
// A joint is a hinge (angles in radians, torques in newton metres) or a slide (metres, newtons); what is not known of
// it stays 0. Pure; any thread; no heap.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/space.hpp"

namespace burin::devices {

// A wand has six, a gripper on an arm adds one, a finger of a glove has three or four.
inline constexpr std::size_t kMostJoints = 8;

enum class JointKind : std::uint8_t { hinge, slide };

struct Joint {
    JointKind kind = JointKind::hinge;
    double step = 0.0;                   // of its encoder: rad or m
    double lowest = 0.0, highest = 0.0;  // of its angle or way: rad or m; both 0: no limit is known
    double max_effort = 0.0;             // Nm or N; 0: it has no motor
};

struct Joints {
    std::uint32_t count = 0;  // 0: nothing is known of them
    std::array<Joint, kMostJoints> all{};
};

// Values of all joints in the order of Joints: rad or m. Those that the device does not have are 0.
using JointValues = std::array<double, kMostJoints>;

[[nodiscard]] inline bool has_limits(const Joint& joint) noexcept { return joint.lowest < joint.highest; }

// Whether all values of a device's joints are finite and none is outside its limits by more than a step: a driver
// reports a fault where they are not, since no hand has brought the joint there.
[[nodiscard]] inline bool within_limits(const Joints& joints, const JointValues& values) noexcept {
    for (std::size_t i = 0; i < joints.count && i < kMostJoints; ++i) {
        const Joint& joint = joints.all[i];
        if (!std::isfinite(values[i])) return false;
        if (has_limits(joint) && (values[i] < joint.lowest - joint.step || values[i] > joint.highest + joint.step))
            return false;
    }
    return true;
}

// The greatest step, along any axis of the device, that one step of every encoder at once makes: what
// DeviceDescription::resolution_m has to be. `columns` is the Jacobian at one pose: how the position moves with each
// joint, in m/rad or m/m. A driver that knows it takes the greatest value over its workspace. With the columns of the
// rotation instead (rad/rad or rad/m) it is orientation_step_rad. 0 where no encoder's step is known.
[[nodiscard]] inline double step_at_handle(const Joints& joints, std::span<const Vec3> columns) noexcept {
    Vec3 step(0.0);
    for (std::size_t i = 0; i < joints.count && i < columns.size() && i < kMostJoints; ++i)
        step += joints.all[i].step * Vec3(std::abs(columns[i].x), std::abs(columns[i].y), std::abs(columns[i].z));
    return std::fmax(step.x, std::fmax(step.y, step.z));
}

}  // namespace burin::devices
