// SPDX-License-Identifier: MIT
#include "haptics/forces/touch_force.hpp"

#include <algorithm>

namespace burin::haptics {

Vec3 touch_force_device(const TouchInput& in) noexcept {
    const Quat device_from_object = glm::conjugate(in.object_from_device_orientation);
    const Vec3 normal_device = device_from_object * in.normal_object;
    const Vec3 spring_N =
        (in.stiffness_N_per_m / in.scale) * (device_from_object * (in.bearing_object_m - in.hip_object_m));
    const double along_N = glm::dot(spring_N, normal_device);
    const double damping_N = -in.damping_Ns_per_m * glm::dot(in.velocity_device_m_per_s, normal_device);
    // The damper never pulls into the surface.
    return spring_N + (std::max(0.0, along_N + damping_N) - along_N) * normal_device;
}

FrictionCone friction_at(const TouchMaterial& material, double slip_speed_m_per_s) noexcept {
    if (!(material.coulomb_velocity_m_per_s > 0.0)) return {material.static_friction, material.dynamic_friction};
    const double share = std::min(1.0, slip_speed_m_per_s / material.coulomb_velocity_m_per_s);
    return {share * material.dynamic_friction, share * material.dynamic_friction};
}

devices::DeviceWrench sum_of(std::span<const PointForce> forces) noexcept {
    devices::DeviceWrench sum;
    for (const PointForce& f : forces) {
        sum.force_device_N += f.force_device_N;
        sum.torque_device_Nm += glm::cross(f.arm_device_m, f.force_device_N);
    }
    return sum;
}

double along_drive_N(const Vec3& force_device_N, const devices::OneWayDrive& drive) noexcept {
    return glm::dot(force_device_N, drive.moves_device);
}

devices::DeviceWrench as_driven(const devices::DeviceWrench& wrench, const devices::OneWayDrive& drive) noexcept {
    if (!drive.is_one()) return wrench;
    return {std::max(0.0, along_drive_N(wrench.force_device_N, drive)) * drive.along_device, Vec3(0.0)};
}

devices::DeviceWrench driven_part(const devices::DeviceWrench& wrench,
                                  const devices::DeviceDescription& device) noexcept {
    devices::DeviceWrench driven = wrench;
    for (int axis = 0; axis < 3; ++axis)
        if (device.max_torque_Nm[axis] == 0.0) driven.torque_device_Nm[axis] = 0.0;
    return driven;
}

devices::DeviceWrench weight_wrench(const WeightSettings& settings, const Quat& orientation_device) noexcept {
    const Vec3 weight_N = settings.tool_mass_kg * kGravity_m_per_s2 * settings.down_device;
    const Vec3 arm_device_m = orientation_device * settings.tool_centre_of_mass_device_m;
    return {weight_N - settings.compensated_mass_kg * kGravity_m_per_s2 * settings.down_device,
            glm::cross(arm_device_m, weight_N)};
}

}  // namespace burin::haptics
