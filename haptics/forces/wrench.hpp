// SPDX-License-Identifier: MIT
// Forces of several points as one force and one torque, and what a held tool weighs.
// Frame: device, about the device's position (the wand's centre, the stylus' tip). Pure.
#pragma once

#include <span>

#include "base/space.hpp"
#include "devices/haptic_device.hpp"

namespace burin {

struct PointForce {
    Vec3 arm_device_m{0.0};  // r_i = R T_i, from the tool's centre to the point
    Vec3 force_device_N{0.0};
};

// F = sum F_i, torque = sum r_i x F_i; in the order given, so that the same inputs give the same bits.
[[nodiscard]] DeviceWrench sum_of(std::span<const PointForce> forces) noexcept;

// Axes that the device cannot drive are left out: a wand's yaw is passive.
[[nodiscard]] DeviceWrench driven_part(const DeviceWrench& wrench, const DeviceDescription& device) noexcept;

// A held tool: its weight is felt, and the device's own arm is not.
struct WeightSettings {
    // What the arm of the device weighs at the hand, held up by the motors; 0: the device does so itself.
    double compensated_mass_kg = 0.0;
    double tool_mass_kg = 0.0;               // of the virtual tool; its weight pulls down
    Vec3 tool_centre_of_mass_device_m{0.0};  // in the tool's axes, from the device's position
    Vec3 down_device{0.0, -1.0, 0.0};        // unit; which way is down in the device frame
};

inline constexpr double kGravity_m_per_s2 = 9.80665;  // standard gravity

[[nodiscard]] DeviceWrench weight_wrench(const WeightSettings& settings, const Quat& orientation_device) noexcept;

}  // namespace burin
