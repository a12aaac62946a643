// SPDX-License-Identifier: MIT
// The sample that a force-feedback device reads in a tick, and the wrench that it is given: plain data of fixed size.
// Code that keeps or shows a sample, and asks no device for one, needs this header alone.
// Frame: device (base/space.hpp).
#pragma once

#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "devices/haptic/joints.hpp"

namespace burin::devices {

// A force and a torque about the device's position, in the device frame. The device ignores components of axes that it
// cannot drive.
struct DeviceWrench {
    Vec3 force_device_N{0.0};
    Vec3 torque_device_Nm{0.0};
};

enum class DeviceFault : std::uint8_t {
    none,
    disconnected,
    overheated,
    overspeed,
    other,
    motors_off,     // it is there, but its motors are off
    force_differs,  // it gives, by its own measurement, another force than it is told
    false_reading,  // a joint of it reads what none can be
};
inline constexpr DeviceFault kLastDeviceFault = DeviceFault::false_reading;

// The one direction in which a part drives, where it has but one: a glove's piston, from its foot on the palm to the
// fingertip. It turns with the pose, so it comes with each sample. It gives a force F at the handle as F . moves_device
// along itself, which does the same work, and only as far as that pushes.
struct OneWayDrive {
    Vec3 along_device{0.0};  // unit: of the force that it gives at the handle; zero: the part drives every direction
    Vec3 moves_device{0.0};  // how the handle moves with the drive's length, in metres a metre; bounded
    double length_m = 0.0;   // from its foot to the handle
    // For those who record or show them; no tick depends on them.
    double measured_N = 0.0;  // what it gives, as the device measures it
    std::uint32_t state = 0;  // bits: DriveState
    [[nodiscard]] bool is_one() const noexcept { return along_device != Vec3(0.0); }
};
enum DriveState : std::uint32_t {
    kDriveOn = 1u << 0,        // its motor is on
    kDriveFault = 1u << 1,     // the device says that something is wrong with it
    kDriveMeasured = 1u << 2,  // measured_N is known
    kDriveBounded = 1u << 3,   // it stands so far across the handle's way that moves_device is bounded
    kDriveLocal = 1u << 4,     // the device's controller renders by itself
};

struct DeviceSample {
    Nanoseconds time_ns = 0;
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    std::uint32_t buttons = 0;  // bit 0: the stylus button
    DeviceFault fault = DeviceFault::none;
    // The fault is of the device that this is a part of, such as a lost cable: all parts get no force. False: of this
    // part alone, and the others go on.
    bool fault_is_of_all = false;
    JointValues joints{};  // as read, for those who record or draw them; no tick depends on them
    OneWayDrive drive{};
};

}  // namespace burin::devices
