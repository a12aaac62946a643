// SPDX-License-Identifier: MIT
// How a surface feels: the force of one point on it, spring and damper along the normal, friction across it; the force
// and torque of several points; and the weight of a held tool.
//
// F = k dx + b dx/dt (Zilles and Salisbury 1995). dx goes from the HIP to the point that bears it; its tangential part
// is friction, which the proxy has already bounded (haptics/contact/god_object.hpp). The damper acts along the normal
// and never pulls into the surface.
// The force of a point: frame object in, device out;
// lengths are divided by the gain. Wrenches: frame device, about the device's position (the wand's centre, the stylus'
// tip). Pure.
#pragma once

#include <cstdint>
#include <span>

#include "base/space.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "haptics/forces/touch_material.hpp"

namespace burin::haptics {

struct TouchInput {
    Vec3 hip_object_m{0.0};
    Vec3 bearing_object_m{0.0};         // the proxy, or the cutting point
    Vec3 normal_object{0.0};            // unit
    Vec3 velocity_device_m_per_s{0.0};  // of the point
    Quat object_from_device_orientation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;
    double stiffness_N_per_m = 0.0, damping_Ns_per_m = 0.0;  // after the limiter
};

[[nodiscard]] Vec3 touch_force_device(const TouchInput& input) noexcept;

// The friction coefficients that the proxy uses. With a Coulomb velocity nothing sticks, and the coefficient follows
// the slip speed.
struct FrictionCone {
    double static_friction = 0.0, dynamic_friction = 0.0;
};
[[nodiscard]] FrictionCone friction_at(const TouchMaterial& material, double slip_speed_m_per_s) noexcept;

// ---- Several points, and the weight

struct PointForce {
    Vec3 arm_device_m{0.0};  // r_i = R T_i, from the tool's centre to the point
    Vec3 force_device_N{0.0};
};

// F = sum F_i, torque = sum r_i x F_i; summed in the order given, so that the same inputs give the same bits.
[[nodiscard]] devices::DeviceWrench sum_of(std::span<const PointForce> forces) noexcept;

// The force of a part that drives one way alone, along its drive: the same work as force_device_N does at the handle;
// negative where it would have to pull.
[[nodiscard]] double along_drive_N(const Vec3& force_device_N, const devices::OneWayDrive& drive) noexcept;
// What such a part gives of a wrench; of any other part the wrench itself.
[[nodiscard]] devices::DeviceWrench as_driven(const devices::DeviceWrench& wrench,
                                              const devices::OneWayDrive& drive) noexcept;

// The wrench without the torque about axes that the device cannot drive: a wand's yaw is passive.
[[nodiscard]] devices::DeviceWrench driven_part(const devices::DeviceWrench& wrench,
                                                const devices::DeviceDescription& device) noexcept;

inline constexpr double kGravity_m_per_s2 = 9.80665;  // standard gravity

[[nodiscard]] devices::DeviceWrench weight_wrench(const WeightSettings& settings,
                                                  const Quat& orientation_device) noexcept;

}  // namespace burin::haptics
