// SPDX-License-Identifier: MIT
// What the gate gives in a tick, and why it gives zero where it does, for ticks to keep and for people to read. How
// that is decided is in haptics/stability/safety_gate.hpp.
// Frame: device. Plain data.
#pragma once

#include <cstdint>

#include "devices/haptic/device_sample.hpp"

namespace burin::haptics {

// Why the gate gives zero. In order of precedence.
enum class GateCause : std::uint8_t {
    none,
    device_fault,    // the device itself reports one; see DeviceSample::fault
    not_finite,      // a sample, a desired force or a device limit is NaN, infinite or negative
    bad_parameters,  // settings that make no sense, such as a negative stiffness
    bad_scale,       // a scene so small or large that numbers do not resolve it at the device's motions
    stale_sample,    // the device has stopped sending
    future_sample,   // its time stamps lie ahead of the loop's clock
    out_of_reach,    // it reports a position that its arm cannot reach
    overspeed,       // the tool moves faster than any hand should
    stale_surface,   // in contact with a surface that the carving side no longer keeps up to date
    outside_known,   // in contact where the surface is not known
    caught,          // the tool was held by a contact that is not there, and has been let go
    lost_loop,       // the loop itself stood still: what it knows of the hand is out of date
};

// A sentence for people; static storage.
[[nodiscard]] const char* text(GateCause cause) noexcept;

struct GateOutput {
    devices::DeviceWrench given;  // the commanded wrench
    GateCause cause = GateCause::none;
    bool saturated = false;
    bool slew_limited = false;
    bool ramping = false;
};

}  // namespace burin::haptics
