// SPDX-License-Identifier: MIT
// A scripted hand: its desired pose at each time, and how firmly it holds the stylus.
//
// The script is a list of time-stamped poses in the device frame (metres, seconds since the start). Between poses
// positions follow straight lines or a monotone cubic (Fritsch and Carlson 1980: passes through the poses without
// overshoot), and orientations a normalised linear interpolation of quaternions. Before the first pose and after the
// last one the hand rests. Buttons hold from one pose to the next. Only +, -, *, / and sqrt are used, so that every
// machine computes the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include "base/error.hpp"
#include "base/space.hpp"
#include "devices/hand/hand_grip.hpp"
#include "devices/hand/hand_target.hpp"

namespace burin::devices {

struct HandPose {
    double time_s = 0.0;
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    std::uint32_t buttons = 0;
};

enum class HandPath : std::uint8_t { straight, monotone_cubic };

// Immutable after create(); any thread may call target().
class SimulatedHand {
public:
    // Fails on an empty script, times that do not rise, numbers that are not finite, a quaternion of zero length
    // (others are normalised), and a grip with negative numbers.
    [[nodiscard]] static Result<SimulatedHand> create(std::vector<HandPose> script, HandPath path = HandPath::straight,
                                                      HandGrip grip = {});

    // The hand's desired state at a time.
    // Wait-free, no heap: a binary search and a few products.
    [[nodiscard]] HandTarget target(double time_s) const noexcept;
    [[nodiscard]] const HandGrip& grip() const noexcept { return grip_; }
    [[nodiscard]] double end_s() const noexcept { return script_.back().time_s; }

private:
    SimulatedHand() = default;
    std::vector<HandPose> script_;
    std::vector<Vec3> slopes_m_per_s_;  // of the monotone cubic, at each pose
    HandPath path_ = HandPath::straight;
    HandGrip grip_;
};

}  // namespace burin::devices
