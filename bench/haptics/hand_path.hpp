// SPDX-License-Identifier: MIT
// Moves the hand in bench haptics: on a given path, pressed into the surface, with a device that does not yield to
// force, so that every run touches the same places.
#pragma once

#include <cmath>
#include <cstdint>

#include "bench/measure/bumpy_sphere.hpp"
#include "devices/haptic/haptic_device.hpp"

namespace burin::bench {

// A haptic device that is moved by the caller.
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
    void go_to(const Vec3& position_device_m, const Quat& orientation_device, Nanoseconds time_ns,
               std::uint32_t buttons = 0) noexcept {
        sample_.position_device_m = position_device_m;
        sample_.orientation_device = orientation_device;
        sample_.time_ns = time_ns;
        sample_.buttons = buttons;
    }
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override { return sample_; }
    void write(const devices::DeviceWrench&) noexcept override {}

private:
    devices::DeviceDescription description_;
    devices::DeviceSample sample_;
};

// A path along a bumpy sphere at 100 mm/s, one tick a millisecond, pressed in by a given depth.
class PressedPath {
public:
    struct Depth {
        double mean_m = 0.0015, swing_m = 0.0005;
    };
    static constexpr double kSpeed_m_per_s = 0.1, kTick_s = 0.001, kSwings_Hz = 0.7;

    PressedPath(const BumpySphere& shape, const Depth& depth) : shape_(shape), depth_(depth) {}

    void step() {
        walk_.step(kSpeed_m_per_s * kTick_s / shape_.radius_m);
        phase_ += 2.0 * 3.14159265358979 * kSwings_Hz * kTick_s;
        const Vec3& n = walk_.outward();
        hip_m_ = (shape_.radius_at_m(n) - depth_.mean_m - depth_.swing_m * std::sin(phase_)) * n;
    }
    [[nodiscard]] const Vec3& hip_m() const { return hip_m_; }
    [[nodiscard]] Quat orientation() const { return walk_.orientation(); }
    [[nodiscard]] const Vec3& outward() const { return walk_.outward(); }

private:
    BumpySphere shape_;
    Depth depth_;
    SphereWalk walk_;
    double phase_ = 0.0;
    Vec3 hip_m_{0.0};
};

}  // namespace burin::bench
