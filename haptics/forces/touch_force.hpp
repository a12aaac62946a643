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

namespace burin::haptics {

// All figures are as felt at the device, whatever the scale of the scene: with a position gain g lengths at the device
// are shorter by g. Any of them may change while the loop runs.
struct TouchMaterial {
    bool enabled = true;  // false: surfaces of this material cannot be felt
    // F = k dx + b dx/dt along the contact normal. 600 N/m is what the Omni renders crisply.
    double stiffness_N_per_m = 600.0;
    double damping_Ns_per_m = 0.5;
    // Coulomb friction: the proxy sticks until the tangential force exceeds static_friction times the normal force,
    // then slides against dynamic_friction times the normal force. 0 <= dynamic_friction <= static_friction.
    double static_friction = 0.0;
    double dynamic_friction = 0.0;
    // Above 0: nothing sticks; friction grows linearly with the slip speed up to this speed (at the device) and is
    // dynamic_friction beyond it.
    double coulomb_velocity_m_per_s = 0.0;
    // Cutting: the engaged area of the tool is resisted by the pressure p0 + H v, v its speed into the material
    // (haptics/forces/cutting.hpp). H: 0 with p0 = 0, it is removed as fast as the hand moves, without resistance;
    // infinite: never.
    double hardness_Ns_per_m3 = 0.0;
    double cutting_yield_Pa = 0.0;  // p0: below it nothing is removed
    // Grain: both swell and fall by this share, at most 1, with this spacing along a unit axis of the object.
    double grain_share = 0.0, grain_spacing_m = 0.0;
    Vec3 grain_axis_object{1.0, 0.0, 0.0};
    // Viscous drag against the motion of a tool that is cutting, per engaged area.
    double cutting_drag_Ns_per_m3 = 0.0;
};

inline constexpr std::uint32_t kMostMaterials = 16;  // in one session; a surface refers to its material by index

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

// A held tool: its weight is felt, that of the device's own arm is not.
struct WeightSettings {
    // Weight of the device's arm at the hand that the motors compensate; 0: the device compensates for it itself.
    double compensated_mass_kg = 0.0;
    double tool_mass_kg = 0.0;               // of the virtual tool; its weight pulls down
    Vec3 tool_centre_of_mass_device_m{0.0};  // in the tool's axes, from the device's position
    Vec3 down_device{0.0, -1.0, 0.0};        // unit; direction of gravity in the device frame
};

inline constexpr double kGravity_m_per_s2 = 9.80665;  // standard gravity

[[nodiscard]] devices::DeviceWrench weight_wrench(const WeightSettings& settings,
                                                  const Quat& orientation_device) noexcept;

}  // namespace burin::haptics
