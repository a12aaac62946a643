// SPDX-License-Identifier: MIT
// The tick's side of a device that a thread of its own serves, be it the maker's library's or ours: the newest state of
// the device comes over, the newest wrench goes back, and a tick never waits for either.
//
// Turns of that thread and ticks are about a period apart, each by its own clock. A sample is where the handle was a
// turn ago, on the straight line between the two newest turns, so that a tick sees a motion, and neither the same place
// twice nor a jump. A state that is older than kServedLost_ns is of a device that is gone.
// Threads: the haptic thread alone; wait-free, no heap.
#pragma once

#include <cstdint>
#include <string>

#include "devices/haptic/haptic_device.hpp"

namespace burin::devices {

inline constexpr Nanoseconds kServedLost_ns = 20'000'000;
// Older wrenches are those of a haptic thread that stands still: the serving thread writes zero in their place.
inline constexpr Nanoseconds kServedSilent_ns = 20'000'000;

struct ServedState {
    Nanoseconds time_ns = 0;  // of the turn; 0: none yet
    Pose pose_device;
    std::uint32_t buttons = 0;
    DeviceFault fault = DeviceFault::other;
    JointValues joints{};
};

struct ServedWrench {
    DeviceWrench wrench;
    Nanoseconds time_ns = 0;
};

// Returns where the handle was at a time: on the straight line between two turns, and nowhere beyond them.
[[nodiscard]] Pose pose_between(const ServedState& before, const ServedState& newest, Nanoseconds time_ns) noexcept;

class ServedSamples {
public:
    explicit ServedSamples(Nanoseconds turn_ns) : turn_ns_(turn_ns) {}
    // Returns the sample of a tick that finds this state.
    [[nodiscard]] DeviceSample sample(const ServedState& newest, Nanoseconds now_ns) noexcept;
    // Whether the last sample was of a device that is well.
    [[nodiscard]] bool may_push() const noexcept { return may_push_; }

private:
    Nanoseconds turn_ns_;
    ServedState newest_, before_;
    bool may_push_ = false;
};

// Returns the path of a library beside the program or in the folder above it; its name alone where it is in neither.
[[nodiscard]] std::string library_beside_program(const char* name);

}  // namespace burin::devices
