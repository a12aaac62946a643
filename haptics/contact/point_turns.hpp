// SPDX-License-Identifier: MIT
// How the points of a probe share a tick's work: by need, and in turns.
//
// The budget is not divided beforehand: the points are served one after the other, and what one leaves over is there
// for the next.
//   Need. A point that needed no more than an equal share in its last step has a claim on that much again, and one that
//   is new has a claim on an equal share. Whoever is served before it leaves its claim alone.
//   Turns. The point that has waited longest is served first, with all that nobody has a claim on; then those whose
//   last step was complete, then those whose was not. A point for which less than its need is left is held over: it
//   stays on its last plane for a tick, and waits.
//   Whole ticks. A point whose work has not sufficed for kPatience ticks, though it was first, may have a tick without
//   claims, so that it has at least as much as a probe of one point. Then the others may have to wait for one tick.
// A point waits from the first tick in which its work does not suffice, or nothing is left for it, until it is done or
// has had a whole tick. The longest waiting is first, and ticks with claims come between whole ticks only as often as
// leaves each its turn (may_be_whole): so nobody waits for more than some twenty ticks, even where each of twenty
// points needs a whole one. Parts that share a turn (TurnShare) begin it in turns, too, so that this holds for twenty
// points in several parts as well.
// Units: nanoseconds as cost_ns() counts (contact_work.hpp). No heap, lock, throw; at most kMostProbePoints^2
// comparisons a tick. A probe of one point has nothing to share, and does not come here.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/contact/probe.hpp"

namespace burin::haptics {

// What the points keep from tick to tick.
struct PointTurns {
    struct Point {
        double needed_ns = 0.0;    // for its last step, not counting the watch; 0: none was made yet
        bool fell_short = false;   // in that step the work did not suffice
        std::uint32_t waited = 0;  // ticks
    };
    std::array<Point, kMostProbePoints> points{};
    std::uint32_t first = 0;           // of the last tick
    std::uint32_t whole_in_a_row = 0;  // ticks without claims
};

// Lets a tick pass in which the whole part is held over.
void wait(PointTurns& turns) noexcept;
[[nodiscard]] bool anyone_waits(const PointTurns& turns) noexcept;

// The order and the shares of one tick.
class PointQueue {
public:
    static constexpr std::uint32_t kPatience = 3, kLongest = 16;  // ticks

    // budget_ns: of a whole tick; left_ns: what of it the parts before have left over. `turns` holds the state before,
    // and gets that after; it must outlive the object.
    PointQueue(PointTurns& turns, std::uint32_t count, double budget_ns, double left_ns) noexcept;

    struct Turn {
        std::uint32_t point = 0;
        double share_ns = 0.0;   // the most that may be spent on it
        double needed_ns = 0.0;  // of it, for the step as far as is known; 0: not known
        bool held_over = false;
    };
    // Returns the next point, with so much left of the tick's budget. Call it once for each point, and serve it or hold
    // it over before the next call.
    [[nodiscard]] Turn next(double left_ns) noexcept;
    // Notes what the step of a point that was served has cost, and whether its share did not suffice.
    void served(const Turn& turn, double cost_ns, bool fell_short) noexcept;

private:
    [[nodiscard]] double claim_of(std::uint32_t point) const noexcept;
    [[nodiscard]] bool may_be_whole(std::uint32_t first) const noexcept;
    [[nodiscard]] bool is_before(std::uint32_t a, std::uint32_t b) const noexcept;
    // The place in the round that begins after the first of the last tick.
    [[nodiscard]] std::uint32_t place_of(std::uint32_t point) const noexcept {
        return (point + count_ - 1 - began_after_) % count_;
    }

    PointTurns& turns_;
    std::uint32_t count_, began_after_;
    double budget_ns_, equal_ns_;
    double claims_ns_ = 0.0;  // of those not yet served
    bool has_whole_tick_, is_whole_ = false;
    std::uint32_t served_count_ = 0;
    std::array<bool, kMostProbePoints> is_done_{};
};

}  // namespace burin::haptics
