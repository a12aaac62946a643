// SPDX-License-Identifier: MIT
#include "haptics/forces/touch_force.hpp"

#include <algorithm>

namespace burin {

Vec3 touch_force_device(const TouchInput& in) noexcept {
    const Quat device_from_object = glm::conjugate(in.object_from_device_orientation);
    const Vec3 normal_device = device_from_object * in.normal_object;
    const Vec3 spring_N =
        (in.stiffness_N_per_m / in.scale) * (device_from_object * (in.bearing_object_m - in.hip_object_m));
    const double along_N = glm::dot(spring_N, normal_device);
    const double damping_N = -in.damping_Ns_per_m * glm::dot(in.velocity_device_m_per_s, normal_device);
    // never into the surface
    return spring_N + (std::max(0.0, along_N + damping_N) - along_N) * normal_device;
}

FrictionCone friction_at(const TouchMaterial& material, double slip_speed_m_per_s) noexcept {
    if (!(material.coulomb_velocity_m_per_s > 0.0)) return {material.static_friction, material.dynamic_friction};
    const double share = std::min(1.0, slip_speed_m_per_s / material.coulomb_velocity_m_per_s);
    return {share * material.dynamic_friction, share * material.dynamic_friction};
}

}  // namespace burin
