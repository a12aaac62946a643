// SPDX-License-Identifier: MIT
// The script of emulated arms: the hand rests above the middle of the workspace, goes down to it and circles there with
// its first button pressed, lifts, and begins anew, for kCirclingScript_s; then it rests. Frame: device.
#pragma once

#include <vector>

#include "devices/hand/simulated_hand.hpp"

namespace burin::devices {

inline constexpr double kCirclingScript_s = 3600.0;
[[nodiscard]] std::vector<HandPose> circling_hand();

}  // namespace burin::devices
