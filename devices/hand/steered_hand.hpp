// SPDX-License-Identifier: MIT
// A hand that is told live where to go: by the mouse of a desk, or by anything else that names a place now and then.
//
// Data flow: the frame thread publishes a SteeredTarget when it knows a new one, some 60 times a second; the haptic thread
// takes the newest and moves towards it. Two steps make a hand's motion of a staircase:
//   goal   goes evenly from where it was to the new target, in the time between the last two targets (the reason for their
//          time stamps). So a mouse that moves evenly gives an even goal, one target late. Buttons take effect when the goal
//          arrives, or with the next target: what is pressed at a place is felt at that place.
//   hand   follows the goal with bounded speed and acceleration, so that a mouse that jumps across the screen does not throw
//          the stylus. Its wanted speed is the least of the limit, distance / lag, and the speed from which it can still stop,
//          sqrt(a distance). Braking along the latter takes a/2, and the former at most a (where the two meet, at the distance
//          a lag^2, v / lag = a), so a resting goal is never passed.
// Buttons hold the newest value that took effect. Only +, -, *, / and sqrt: every machine computes the same bits.
//
// Frame: device, metres. Time: that of whoever asks, from 0; steps of 50 us inside, so the bits do not depend on how often one
// asks. In simulated time the same targets published between the same questions give the same bits.
// Threads: one writer of the channel, one reader (target()). Wait-free: no heap, lock or throw. A copy follows the same channel
// and must not be asked beside the original.
#pragma once

#include "base/clock.hpp"
#include "base/newest_slot.hpp"
#include "devices/simulated_hand.hpp"

namespace burin {

struct SteeredTarget {
    std::uint64_t sequence = 0;  // rises with every target; 0: never published
    Nanoseconds time_ns = 0;     // when it was known, on the writer's clock; only differences count
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};  // any length but 0
    std::uint32_t buttons = 0;
};

using HandSteering = NewestSlot<SteeredTarget>;

// A brisk arm. All positive. An even motion is followed lag_s late up to acceleration * lag_s (0.16 m/s), and v / acceleration
// beyond (15 ms at 0.6 m/s): the price of never passing a goal that stops.
struct SteeringLimits {
    double speed_m_per_s = 0.6;
    double acceleration_m_per_s2 = 40.0;
    double lag_s = 0.004;
};

class SteeredHand {
public:
    static constexpr Nanoseconds kStep_ns = 50'000;
    // Targets that come faster or slower than this are taken as coming at this distance: a goal neither jumps nor crawls.
    static constexpr Nanoseconds kLeastInterval_ns = 2'000'000;
    static constexpr Nanoseconds kMostInterval_ns = 50'000'000;
    // One question moves the hand on by at most this; the rest of the time it stood still.
    static constexpr Nanoseconds kMostCatchUp_ns = 100'000'000;

    // Starts at rest in the pose given. Fails without a channel, with limits that are not finite and positive, a grip with
    // negative numbers, or a start that is not finite. The channel must outlive the hand.
    [[nodiscard]] static Result<SteeredHand> create(HandSteering* channel, const HandTarget& start = {},
                                                    const SteeringLimits& limits = {}, HandGrip grip = {});

    // Where the hand wants to be at that time; a time before the last one asked gives what was last. Takes the newest
    // target. A target that is not finite is passed over.
    [[nodiscard]] HandTarget target(double time_s) noexcept;
    [[nodiscard]] const HandGrip& grip() const noexcept { return grip_; }
    // Targets passed over because a number was not finite.
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

}  // namespace burin
