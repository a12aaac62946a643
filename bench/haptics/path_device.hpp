// SPDX-License-Identifier: MIT
// A haptic device that is moved by the caller and does not yield to force, for runs that touch the same places every
// time.
#pragma once

#include "devices/haptic/haptic_device.hpp"

namespace burin::bench {

class PathDevice final : public devices::HapticDevice {
public:
    PathDevice() {
        description_.name = "path";
        description_.workspace_m = Vec3(1.0);
        description_.max_force_N = 3.3;
        description_.max_stiffness_N_per_m = 1e6;
        description_.apparent_mass_kg = 0.045;
        description_.damping_Ns_per_m = 5.0;
        description_.friction_N = 0.26;
    }
    void go_to(const Vec3& position_device_m, const Quat& orientation_device, Nanoseconds time_ns) noexcept {
        sample_.position_device_m = position_device_m;
        sample_.orientation_device = orientation_device;
        sample_.time_ns = time_ns;
    }
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override { return sample_; }
    void write(const devices::DeviceWrench&) noexcept override {}

private:
    devices::DeviceDescription description_;
    devices::DeviceSample sample_;
};

}  // namespace burin::bench
