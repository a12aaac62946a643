// SPDX-License-Identifier: MIT
// What a force-feedback device is to the rest of Burin: a description, samples in, forces out, all plain data.
// Frames: everything here is in the device frame (base/space.hpp). Threads: read() and write() are called by the haptic
// thread only, once a tick each, and must be wait-free: no heap, lock, throw or file.
#pragma once

#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin {

// What the device can do; the safety gate and the workspace mapping are set up from it.
struct DeviceDescription {
    const char* name = "";
    Vec3 workspace_m{0.0};             // width (x), height (y), depth (z) of the box centred on the device origin
    double resolution_m = 0.0;         // position quantum
    double max_force_N = 0.0;          // peak the device takes
    double max_stiffness_N_per_m = 0;  // stiffest wall it should be asked to render
    double rate_Hz = 1000.0;           // servo rate
};

enum class DeviceFault : std::uint8_t { none, disconnected, overheated, overspeed, other };

struct DeviceSample {
    Nanoseconds time_ns = 0;
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    std::uint32_t buttons = 0;  // bit 0: the stylus button
    DeviceFault fault = DeviceFault::none;
};

// Inheritance, because which device is there is known only at run time.
class HapticDevice {
public:
    virtual ~HapticDevice() = default;
    [[nodiscard]] virtual const DeviceDescription& description() const noexcept = 0;
    [[nodiscard]] virtual DeviceSample read() noexcept = 0;
    virtual void write(const Vec3& force_device_N) noexcept = 0;
};

}  // namespace burin
