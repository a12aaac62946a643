// SPDX-License-Identifier: MIT
// A hand steered live by the desktop's mouse, or by any other source that sends a target position now and then.
//
// Data flow: the frame thread publishes a SteeredTarget when it has a new one, some 60 times a second; the haptic
// thread takes the newest and moves towards it. Two steps turn these discrete targets into a hand's smooth motion:
//   goal   moves at constant speed from its last position to the new target, in the time between the last two targets
//          (which is why they carry time stamps). So a mouse that moves evenly gives an even goal, one target late.
//          Buttons take effect when the goal arrives, or with the next target: what is pressed at a position is felt at
//          that position.
//   hand   follows the goal with bounded speed and acceleration, so that a mouse that jumps across the screen does not
//          throw the stylus. Its desired speed is the least of the limit, distance / lag, and the speed from which it
//          can still stop, sqrt(a distance). Braking along the latter takes a/2, and along the former at most a (where
//          the two meet, at the distance a lag^2, v / lag = a), so a resting goal is never passed.
// Buttons hold the newest value that took effect. Only +, -, *, / and sqrt are used: every machine computes the same
// bits.
//
// Frame: device, metres. Time: the caller's, from 0; internal steps of 50 us, so the bits do not depend on how often
// target() is called. In simulated time the same targets published between the same calls give the same bits.
// Threads: one writer of the channel, one reader (target()). Wait-free: no heap, lock or throw. A copy follows the same
// channel and must not be used beside the original.
#pragma once

#include "base/clock.hpp"
#include "base/newest_slot.hpp"
#include "devices/hand/simulated_hand.hpp"

namespace burin::devices {

struct SteeredTarget {
    std::uint64_t sequence = 0;  // rises with every target; 0: never published
    // When it was determined, on the writer's clock; only differences count.
    Nanoseconds time_ns = 0;
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};  // any length but 0
    std::uint32_t buttons = 0;
};

using HandSteering = NewestSlot<SteeredTarget>;

// Limits of a brisk arm, all positive. A uniform motion is followed lag_s late up to acceleration * lag_s (0.16 m/s),
// and v / acceleration late beyond (15 ms at 0.6 m/s): the price of never passing a goal that stops.
struct SteeringLimits {
    double speed_m_per_s = 0.6;
    double acceleration_m_per_s2 = 40.0;
    double lag_s = 0.004;
};

class SteeredHand {
public:
    static constexpr Nanoseconds kStep_ns = 50'000;
    // Clamp of the interval between targets, so that the goal neither jumps nor crawls.
    static constexpr Nanoseconds kLeastInterval_ns = 2'000'000;
    static constexpr Nanoseconds kMostInterval_ns = 50'000'000;
    // The longest time by which one call moves the hand on; for the rest of a longer time it stood still.
    static constexpr Nanoseconds kMostCatchUp_ns = 100'000'000;

    // Starts at rest in the pose given. Fails without a channel, with limits that are not finite and positive, a lag
    // shorter than a step, a grip with negative numbers, or a start that is not finite. The channel must outlive the
    // hand.
    [[nodiscard]] static Result<SteeredHand> create(HandSteering* channel, const HandTarget& start = {},
                                                    const SteeringLimits& limits = {}, HandGrip grip = {});

    // The hand's desired state at a time; for a time before the last call, the last state. Takes the newest target and
    // ignores it if it is not finite.
    [[nodiscard]] HandTarget target(double time_s) noexcept;
    [[nodiscard]] const HandGrip& grip() const noexcept { return grip_; }
    // Number of targets ignored because a number was not finite.
    [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

private:
    struct Goal {
        Vec3 position_m{0.0};
        Quat orientation{1.0, 0.0, 0.0, 0.0};
    };
    SteeredHand() = default;
    void take_newest() noexcept;
    [[nodiscard]] Goal goal() const noexcept;
    void step() noexcept;

    HandSteering* channel_ = nullptr;
    SteeringLimits limits_;
    HandGrip grip_;
    Nanoseconds time_ns_ = 0;
    Goal from_, to_;
    Nanoseconds set_out_ns_ = 0;  // when the goal left from_
    Nanoseconds interval_ns_ = kLeastInterval_ns;
    std::uint32_t buttons_at_goal_ = 0;
    std::uint64_t sequence_ = 0;
    Nanoseconds stamp_ns_ = 0;
    std::uint64_t refused_ = 0;
    HandTarget hand_;
};

}  // namespace burin::devices
