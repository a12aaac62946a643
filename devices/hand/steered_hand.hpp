// SPDX-License-Identifier: MIT
// A hand steered live by the desktop's mouse, a script, or any other source that sends target positions with times.
//
// Data flow: source -> HandSteering (a ring: every target in order, none skipped) -> goal -> hand.
//   goal   moves through the targets along a smooth curve, each at its own time plus a play-out delay. Buttons take
//          effect when the goal arrives: what is pressed at a position is felt at that position.
//   hand   follows the goal with bounded speed and acceleration, so that a mouse that jumps across the screen does not
//          throw the stylus. Its desired speed is the least of the limit, distance / lag, and the speed from which it
//          can still stop, sqrt(a distance). Braking along the latter takes a/2, and along the former at most a (where
//          the two meet, at the distance a lag^2, v / lag = a), so a resting goal is never passed.
//
// The hardest case is a target that comes late while the goal is under way: the goal has to stop for it, and a tool
// that stops while it is pressed sinks in. So the delay is chosen such that each target has come when the goal sets out
// to it. A target needs the delay (its arrival - the time of the target before it); where targets are so far apart that
// the curve needs the one beyond as well (from 50 to 100 ms), up to an interval more. The delay in use is the greatest
// need of the last 1.5 to 3 s. It grows at once where the goal rests anyway, and is then there from a stroke's
// beginning; under way it grows and shrinks by slowing the goal down or speeding it up by a fiftieth. A target at the
// place of the one before is never late: the goal rests there already. A target that nevertheless comes late finds the
// goal waiting. After a gap of over 350 ms the source is taken to have rested until 50 ms before. The delay is half
// a second at most; targets that have piled up by a tenth more are gone through faster.
//
// The curve is a cubic Hermite spline over the targets' times. Its velocity at a target is that of the polynomial
// through up to five targets, one of them later if it is known: a circle given by ten targets a turn is followed within
// 0.0003 of its radius. It is bounded so that the curve never goes back nor beyond a target at which it rests. At a
// corner (a turn by more than 60 degrees, or by more than 5 and three times that before), and where a rest begins or
// ends, the velocity changes at once, as it does with many targets. Straight, even paths stay so to rounding.
//
// Only +, -, *, / and sqrt are used: every machine computes the same bits.
// Frame: device, metres. Time: the caller's, from 0; internal steps of 50 us, so the bits do not depend on how often
// target() is called. In simulated time the same targets published between the same calls give the same bits.
// Threads: one writer of the channel, one reader (target()). Wait-free: no heap, lock or throw. A copy follows the same
// channel and must not be used beside the original.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>

#include "base/clock.hpp"
#include "base/ring.hpp"
#include "devices/hand/hand_target.hpp"
#include "devices/hand/simulated_hand.hpp"

namespace burin::devices {

// The channel. Its writer puts times into an order that the reader can rely on: rising by at least kLeastInterval_ns,
// gaps closed.
class HandSteering {
public:
    static constexpr std::size_t kTargets = 4096;
    static constexpr Nanoseconds kLeastInterval_ns = 100'000;
    // A longer gap between targets means that the source rested, until kRestart_ns before the next.
    static constexpr Nanoseconds kMostInterval_ns = 350'000'000, kRestart_ns = 50'000'000;

    explicit HandSteering(std::size_t capacity = kTargets) : ring_(capacity) {}

    // Writer only: appends a target. False where a number is not finite, or the ring is full; both are counted.
    bool push(const SteeredTarget& target) noexcept;
    // Any thread.
    [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::uint64_t lost() const noexcept { return ring_.refused(); }

private:
    friend class SteeredHand;
    struct Entry {
        SteeredTarget target;        // its time rising, its orientation of unit length
        Nanoseconds skipped_ns = 0;  // what was taken out of the gap before it
    };
    Ring<Entry> ring_;
    bool begun_ = false;
    Nanoseconds raw_ns_ = 0;   // the time of the last target as it was given
    Nanoseconds time_ns_ = 0;  // and as it was passed on
    std::atomic<std::uint64_t> refused_{0};
};

// Limits of a brisk arm, all positive. A uniform motion is followed lag_s late up to acceleration * lag_s (0.16 m/s),
// and v / acceleration late beyond (15 ms at 0.6 m/s): the price of never passing a goal that stops.
struct SteeringLimits {
    double speed_m_per_s = 0.6;
    double acceleration_m_per_s2 = 40.0;
    double lag_s = 0.004;
    // A button goes down once the hand is this near to the place where it was pressed; 0: once the goal is there.
    double pressed_within_m = 0.0;
};

class SteeredHand {
public:
    static constexpr Nanoseconds kStep_ns = 50'000;
    // The longest time by which one call moves the hand on; for the rest of a longer time it stood still.
    static constexpr Nanoseconds kMostCatchUp_ns = 100'000'000;
    // The greatest delay: from when a target came until the goal reaches it.
    static constexpr Nanoseconds kMostDelay_ns = 500'000'000;
    // A button is held at least this long, so that a tick sees it.
    static constexpr Nanoseconds kLeastPress_ns = 2'000'000;

    // Starts at rest in the pose given. Fails without a channel, with limits that are not finite and positive, a lag
    // shorter than a step, a grip with negative numbers, or a start that is not finite. The channel must outlive the
    // hand.
    [[nodiscard]] static Result<SteeredHand> create(HandSteering* channel, const HandTarget& start = {},
                                                    const SteeringLimits& limits = {}, HandGrip grip = {});

    // The hand's desired state at a time; for a time before the last call, the last state.
    [[nodiscard]] HandTarget target(double time_s) noexcept;
    [[nodiscard]] const HandGrip& grip() const noexcept { return grip_; }
    // Holds more or less firmly, before the first call of target(). Fails on a grip with negative numbers.
    [[nodiscard]] Result<void> hold_by(const HandGrip& grip);
    // Has buttons that go down wait for the hand (SteeringLimits::pressed_within_m), before the first call of target().
    void press_within(double distance_m) { limits_.pressed_within_m = distance_m; }

private:
    static constexpr Nanoseconds kNoNeed_ns = -(Nanoseconds{1} << 60);
    struct Knot {
        Nanoseconds time_ns = 0;
        Vec3 position_m{0.0};
        Quat orientation{1.0, 0.0, 0.0, 0.0};
    };
    SteeredHand() = default;
    // ---- What the targets need
    void look_at_arrivals() noexcept;
    void note_need(const Knot& before, const Knot& target) noexcept;
    void shift_needs(Nanoseconds by_ns) noexcept;
    [[nodiscard]] Nanoseconds delay_ns() const noexcept { return std::max(need_ns_[0], need_ns_[1]); }
    // ---- The goal
    [[nodiscard]] Knot knot(std::size_t older) const noexcept;
    [[nodiscard]] const HandSteering::Entry& next() const noexcept { return channel_->ring_.at(0); }
    [[nodiscard]] static bool is_same_place(const Knot& a, const Knot& b) noexcept {
        return a.position_m == b.position_m && a.orientation == b.orientation;
    }
    [[nodiscard]] bool rests() const noexcept { return is_same_place(from_, to_); }
    void move_goal() noexcept;
    [[nodiscard]] bool may_set_out() const noexcept;
    void set_out() noexcept;
    void play_on() noexcept;
    [[nodiscard]] bool arrive() noexcept;
    [[nodiscard]] Vec3 arriving() const noexcept;
    [[nodiscard]] Vec3 leaving() noexcept;
    [[nodiscard]] bool turns_at(const Knot& at, const Knot& before, const Knot& after) const noexcept;
    [[nodiscard]] Knot goal() const noexcept;
    // ---- The hand
    void step() noexcept;

    HandSteering* channel_ = nullptr;
    SteeringLimits limits_;
    HandGrip grip_;
    Nanoseconds time_ns_ = 0;

    std::size_t looked_at_ = 0;  // waiting targets whose needs are known
    // Needs of the targets, as hand's time - source's time: the greatest of this period, and of the one before.
    std::array<Nanoseconds, 2> need_ns_{kNoNeed_ns, kNoNeed_ns};
    Nanoseconds period_began_ns_ = 0;
    std::uint32_t needs_ = 0;  // noted in this period
    bool delayed_ = false;     // a need has been noted

    std::array<Knot, 3> behind_;  // targets before from_, the latest first
    std::size_t run_ = 0;         // how many of them lie on one smooth path with from_
    Knot from_, to_;
    bool under_way_ = false;                    // from from_ to to_, which is the oldest waiting target
    Vec3 arriving_m_per_s_{0.0};                // at to_, or at from_ while not under way
    Vec3 leaving_m_per_s_{0.0};                 // at from_
    Nanoseconds played_ns_ = 0;                 // the source's time at which the goal is
    Nanoseconds arrived_ns_ = 0;                // when the goal came to from_, by the hand's time
    bool came_moving_ = false;                  // the goal came to from_ from elsewhere
    Nanoseconds pressed_ns_ = -kLeastPress_ns;  // when buttons changed last
    HandTarget hand_;
};

}  // namespace burin::devices
