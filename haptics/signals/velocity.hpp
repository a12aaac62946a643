// SPDX-License-Identifier: MIT
// Velocity from quantised positions: first-order adaptive windowing with end fit (Janabi-Sharifi, Hayward, Chen 2000).
//
// For each axis the longest window of at most N ticks is taken whose straight line between its ends passes within the
// noise bound of every position between: long at rest (little noise), short when the motion changes (little lag). With
// one 0.055 mm step a tick worth 55 mm/s at 1 kHz, a plain difference is useless for damping.
// Frame: whatever the positions are in. Pure, at most N^2/2 operations an axis.
#pragma once

#include <array>
#include <cstdint>

#include "base/space.hpp"

namespace burin {

struct VelocityWindow {
    static constexpr std::uint32_t kLongest = 16;  // ticks; 16 ms of lag at most when at rest
    std::array<Vec3, kLongest + 1> positions_m{};  // a ring
    std::uint32_t newest = 0;                      // index of the newest
    std::uint32_t count = 0;                       // how many are valid
};

[[nodiscard]] VelocityWindow with_position(VelocityWindow window, const Vec3& position_m) noexcept;

// Zero until two positions are known. noise_m >= 0: how far a position may be from the truth.
[[nodiscard]] Vec3 velocity_m_per_s(const VelocityWindow& window, double noise_m, double dt_s) noexcept;

}  // namespace burin
