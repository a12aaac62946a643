// SPDX-License-Identifier: MIT
// Four fingertips of one hand as a device of four parts: each is a simulated finger (simulated_fingers.hpp), pulled to
// its place in the hand. The hand's pose is led as a stylus' is; its first button closes the fingers onto each other,
// as far as what they touch lets them.
//
// Places, in the frame of the hand, whose +Y points from wrist to fingers and whose +Z away from the palm: index,
// middle and ring lie side by side, the thumb opposite the middle one. Closed, the tips are kClosed_m from the middle.
// Time and threads as SimulatedOmni. The first part's read() leads the hand, so that all parts of a turn see one hand:
// the loop reads them in their order (haptic_device.hpp).
#pragma once

#include <cstddef>

#include "base/clock.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/simulated_omni.hpp"

namespace burin::devices {

inline constexpr const char* kSimulatedFingers = "simulated-fingers";
inline constexpr std::size_t kFingers = 4;
// How far fingertips are from the hand's middle, open and closed.
inline constexpr double kOpen_m = 0.035, kClosed_m = 0.006;
// How fast they close and open.
inline constexpr double kClosing_m_per_s = 0.06;

// The clock must outlive the parts.
[[nodiscard]] OpenedDevice simulated_fingers(AnyHand hand, Clock& clock);

}  // namespace burin::devices
