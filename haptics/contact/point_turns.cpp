// SPDX-License-Identifier: MIT
#include "haptics/contact/point_turns.hpp"

#include <algorithm>

namespace burin::haptics {
namespace {

// A step costs up to so many times the one before in most ticks.
constexpr double kMargin = 1.25;
// What is always claimed, for a point that comes to touch something; nor is any served with less.
constexpr double kLeastClaim_ns = 4000.0;
// A tick is whole if the parts before have left this part of it.
constexpr double kWhole = 0.9;

}  // namespace

void wait(PointTurns& turns) noexcept {
    for (PointTurns::Point& point : turns.points) point.waited += point.waited > 0 ? 1 : 0;
}

bool anyone_waits(const PointTurns& turns) noexcept {
    return std::ranges::any_of(turns.points, [](const PointTurns::Point& point) { return point.waited > 0; });
}

PointQueue::PointQueue(PointTurns& turns, std::uint32_t count, double budget_ns, double left_ns) noexcept
    : turns_(turns),
      count_(count),
      began_after_(std::min(turns.first, count - 1)),
      budget_ns_(budget_ns),
      equal_ns_(left_ns / count),
      has_whole_tick_(left_ns >= kWhole * budget_ns) {}

// Among those that wait equally long, the round goes on where the last tick began.
bool PointQueue::is_before(std::uint32_t a, std::uint32_t b) const noexcept {
    const PointTurns::Point &pa = turns_.points[a], &pb = turns_.points[b];
    if (served_count_ > 0 && pa.fell_short != pb.fell_short) return pb.fell_short;
    if (pa.waited != pb.waited) return pa.waited > pb.waited;
    return place_of(a) < place_of(b);
}

double PointQueue::claim_of(std::uint32_t point) const noexcept {
    const PointTurns::Point& p = turns_.points[point];
    if (p.needed_ns == 0.0) return equal_ns_;
    if (p.fell_short || p.needed_ns > equal_ns_) return 0.0;
    return std::min(std::max(kMargin * p.needed_ns, kLeastClaim_ns), equal_ns_);
}

// Of n points w wait for whole ticks, which follow each other at most w / (n - w) times before a tick with claims
// comes: both together make n ticks. Whoever has waited for kLongest has one in any case.
bool PointQueue::may_be_whole(std::uint32_t first) const noexcept {
    const PointTurns::Point& p = turns_.points[first];
    if (!has_whole_tick_ || !p.fell_short || p.waited < kPatience) return false;
    if (p.waited >= kLongest) return true;
    std::uint32_t waiting = 0;
    for (std::uint32_t i = 0; i < count_; ++i) waiting += turns_.points[i].fell_short ? 1 : 0;
    return waiting == count_ || turns_.whole_in_a_row * (count_ - waiting) < waiting;
}

PointQueue::Turn PointQueue::next(double left_ns) noexcept {
    Turn turn;
    turn.point = count_;
    for (std::uint32_t i = 0; i < count_; ++i)
        if (!is_done_[i] && (turn.point == count_ || is_before(i, turn.point))) turn.point = i;
    if (served_count_ == 0) {
        turns_.first = turn.point;
        is_whole_ = may_be_whole(turn.point);
        turns_.whole_in_a_row = is_whole_ ? turns_.whole_in_a_row + 1 : 0;
        for (std::uint32_t i = 0; i < count_ && !is_whole_; ++i) claims_ns_ += claim_of(i);
    }
    const PointTurns::Point& p = turns_.points[turn.point];
    if (!is_whole_) claims_ns_ = std::max(claims_ns_ - claim_of(turn.point), 0.0);
    turn.share_ns = std::max(left_ns - claims_ns_, 0.0);
    turn.needed_ns = p.fell_short ? 0.0 : p.needed_ns;
    // The first is served in any case. Of the last, a point whose work has not sufficed takes an equal share as well.
    const double least_ns = p.fell_short ? std::min(p.needed_ns, equal_ns_) : p.needed_ns;
    turn.held_over = served_count_ > 0 && turn.share_ns < std::max(least_ns, std::min(kLeastClaim_ns, equal_ns_));
    is_done_[turn.point] = true;
    ++served_count_;
    if (turn.held_over) ++turns_.points[turn.point].waited;
    return turn;
}

void PointQueue::served(const Turn& turn, double cost_ns, bool fell_short) noexcept {
    PointTurns::Point& p = turns_.points[turn.point];
    p.fell_short = fell_short;
    p.needed_ns = std::max(cost_ns, 1.0);
    const bool was_whole = turns_.first == turn.point && (is_whole_ || turn.share_ns >= kWhole * budget_ns_);
    p.waited = p.fell_short && !was_whole ? p.waited + 1 : 0;
}

}  // namespace burin::haptics
