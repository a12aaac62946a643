// SPDX-License-Identifier: MIT
// How a scripted hand closes: the joints of its fingers between open and closed, and how each stops at what it touches.
// Pure; no heap; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "devices/gloves/glove_frame.hpp"

namespace burin::devices {

enum class GripShape : std::uint8_t { whole, pinch, point };
inline constexpr std::array<std::string_view, 3> kGripNames{"whole", "pinch", "point"};
[[nodiscard]] std::optional<GripShape> grip_named(std::string_view name);

// Returns the angles of a finger (thumb, index, middle, ring) that is closed by a share of 0, open, to 1.
[[nodiscard]] FingerAngles bent_in(GripShape shape, std::size_t finger, double closed);

// Closes or opens the fingers towards a share. One that is pushed open closes more slowly, and stops at kHolds_N.
struct Grip {
    static constexpr double kCloses_per_s = 0.6, kHolds_N = 2.0;
    std::array<double, kGloveFingers> closed{};
};
[[nodiscard]] Grip stepped(Grip grip, double towards, const GloveForces& pushed_N, double time_s);

}  // namespace burin::devices
