// SPDX-License-Identifier: MIT
// Lengths and times that many tests count in.
#pragma once

#include "base/clock.hpp"

namespace burin {

inline constexpr Nanoseconds kMs = 1'000'000;
inline constexpr double kMm = 1e-3;            // metres
inline constexpr double kDt = 1e-3;            // seconds: the period of the haptic loop
inline constexpr double kEncoderStep = 55e-6;  // metres: the position resolution of a common desktop device

}  // namespace burin
