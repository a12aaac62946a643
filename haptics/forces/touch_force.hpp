// SPDX-License-Identifier: MIT
// The force of one point on a surface: spring and damper along the normal, friction across it.
//
// F = k dx + b dx/dt (Zilles and Salisbury 1995). dx goes from the HIP to where the surface bears it; its part across the
// normal is friction's, which the proxy has bounded already (haptics/contact/god_object.hpp). The damper acts along the
// normal and never pulls into the surface.
// Frame: object in, device out; lengths shrink by the gain on their way. Pure.
#pragma once

#include "base/space.hpp"
#include "haptics/forces/touch_material.hpp"

namespace burin {

struct TouchInput {
    Vec3 hip_object_m{0.0};
    Vec3 bearing_object_m{0.0};         // the proxy, or where the tool has eaten to
    Vec3 normal_object{0.0};            // unit
    Vec3 velocity_device_m_per_s{0.0};  // of the point
    Quat object_from_device_orientation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;
    double stiffness_N_per_m = 0.0, damping_Ns_per_m = 0.0;  // after the limiter
};

[[nodiscard]] Vec3 touch_force_device(const TouchInput& input) noexcept;

// The friction that the proxy shall render: static and dynamic coefficient. With a Coulomb velocity nothing sticks, and the
// coefficient follows the slip speed.
struct FrictionCone {
    double static_friction = 0.0, dynamic_friction = 0.0;
};
[[nodiscard]] FrictionCone friction_at(const TouchMaterial& material, double slip_speed_m_per_s) noexcept;

}  // namespace burin
