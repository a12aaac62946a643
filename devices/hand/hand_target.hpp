// SPDX-License-Identifier: MIT
// Where a simulated hand is to be: at one time, as a script or a steered hand has it, or as whoever steers one says.
// Plain data; frame: device, metres.
#pragma once

#include <cstdint>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin::devices {

// The desired state of the hand at one time.
struct HandTarget {
    Vec3 position_device_m{0.0};
    Vec3 velocity_device_m_per_s{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    std::uint32_t buttons = 0;
};

// Target that a steered hand follows (devices/hand/steered_hand.hpp).
struct SteeredTarget {
    // When the source was there, on its own clock; only differences count. A source that reports changes alone says
    // where it was shortly before a change that follows a rest.
    Nanoseconds time_ns = 0;
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};  // any length but 0
    std::uint32_t buttons = 0;
};

}  // namespace burin::devices
