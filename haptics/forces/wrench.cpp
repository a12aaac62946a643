// SPDX-License-Identifier: MIT
#include "haptics/forces/wrench.hpp"

namespace burin {

DeviceWrench sum_of(std::span<const PointForce> forces) noexcept {
    DeviceWrench sum;
    for (const PointForce& f : forces) {
        sum.force_device_N += f.force_device_N;
        sum.torque_device_Nm += glm::cross(f.arm_device_m, f.force_device_N);
    }
    return sum;
}

DeviceWrench driven_part(const DeviceWrench& wrench, const DeviceDescription& device) noexcept {
    DeviceWrench driven = wrench;
    for (int axis = 0; axis < 3; ++axis)
        if (device.max_torque_Nm[axis] == 0.0) driven.torque_device_Nm[axis] = 0.0;
    return driven;
}

DeviceWrench weight_wrench(const WeightSettings& settings, const Quat& orientation_device) noexcept {
    const Vec3 weight_N = settings.tool_mass_kg * kGravity_m_per_s2 * settings.down_device;
    const Vec3 arm_device_m = orientation_device * settings.tool_centre_of_mass_device_m;
    return {weight_N - settings.compensated_mass_kg * kGravity_m_per_s2 * settings.down_device,
            glm::cross(arm_device_m, weight_N)};
}

}  // namespace burin
