// SPDX-License-Identifier: MIT
#include "devices/gloves/glove_timeline.hpp"

#include <algorithm>
#include <cmath>

#include "devices/gloves/glove_hand.hpp"

namespace burin::devices {
namespace {

constexpr std::int64_t kLineBytes_per_s = 3840;
// So many sets tell a period of the controller's that is not the line's own.
constexpr std::size_t kPeriodFrom = 8;
// How far apart the delays of two sets may be: a period that is measured between them is another only beyond that.
constexpr Nanoseconds kBunch_ns = 20'000'000;
// Numbers farther apart than so are no sets that were lost.
constexpr std::uint8_t kFarApart = 16;
constexpr Nanoseconds kShortestPeriod_ns = 4'000'000, kLongestPeriod_ns = 30'000'000;
constexpr std::int64_t kForgetPart = 128;  // of a need that is forgotten a set

// Returns whether a joint has turned faster between two sets than any finger does.
bool jumps(const TimedSet& from, const TimedSet& to) {
    // Times of sets that say no number may fall together; the controller took them a period apart.
    const double between_s = seconds(std::max(to.taken_ns - from.taken_ns, set_period_ns(to.set)));
    for (std::size_t i = 0; i < kGloveFingers; ++i)
        for (std::size_t k = 0; k < kFingerJoints; ++k)
            if (!(std::abs(to.set.joints[i][k] - from.set.joints[i][k]) <= kFastestJoint_rad_per_s * between_s))
                return true;
    return false;
}

}  // namespace

Nanoseconds set_period_ns(const GloveSet& set) noexcept {
    return static_cast<std::int64_t>(bytes_of(set)) * kNanosecondsPerSecond / kLineBytes_per_s;
}

void GloveTimeline::begin_anew(std::uint64_t number, Nanoseconds now_ns, bool keeps_period) noexcept {
    if (!keeps_period) {
        arrivals_known_ = next_arrival_ = 0;
        period_ns_ = 0;
    }
    soonest_of_ = 0;
    catches_up_ns_ = 0;
    number_ = number;
    taken_ns_ = now_ns;
}

// Measures the period between the arrivals of sets that are many numbers apart.
void GloveTimeline::follow_period(std::uint64_t number, Nanoseconds now_ns) noexcept {
    if (arrivals_known_ >= kPeriodFrom) {
        const Arrival& first = arrivals_[arrivals_known_ < kWatched ? 0 : next_arrival_];
        const auto sets = static_cast<Nanoseconds>(number - first.number);
        const Nanoseconds measured_ns =
            sets > 0 ? std::clamp((now_ns - first.time_ns) / sets, kShortestPeriod_ns, kLongestPeriod_ns) : period_ns_;
        if (std::abs(measured_ns - period_ns_) > kBunch_ns / std::max(sets, Nanoseconds{1})) period_ns_ = measured_ns;
    }
    arrivals_[next_arrival_] = {number, now_ns};
    next_arrival_ = (next_arrival_ + 1) % kWatched;
    arrivals_known_ = std::min(arrivals_known_ + 1, kWatched);
}

// Returns by how much later than expected a set that came so late was taken.
Nanoseconds GloveTimeline::catch_up(Nanoseconds late_ns) noexcept {
    soonest_ns_ = soonest_of_ == 0 ? late_ns : std::min(soonest_ns_, late_ns);
    if (++soonest_of_ == kSoonestOf) {
        catches_up_ns_ = soonest_ns_ / static_cast<Nanoseconds>(kSoonestOf);
        soonest_of_ = 0;
    }
    return std::min(catches_up_ns_, late_ns);
}

// Returns when the controller took a set that has come now.
Nanoseconds GloveTimeline::time_of(const GloveSet& set, Nanoseconds now_ns) noexcept {
    const auto apart = static_cast<std::uint8_t>(last_number_ ? set.number - *last_number_ : 0);
    last_number_ = set.number;
    if (period_ns_ == 0) period_ns_ = set_period_ns(set);
    const Nanoseconds expected_ns = taken_ns_ + apart * period_ns_;
    if (apart == 0 || std::abs(now_ns - expected_ns) > kAstray_ns) {
        const bool was_silent = now_ns - arrived_ns_ > kAstray_ns;
        begin_anew(number_ + std::max<std::uint8_t>(apart, 1), now_ns, apart > 0 && apart < kFarApart && !was_silent);
        arrived_ns_ = now_ns;
        if (period_ns_ == 0) period_ns_ = set_period_ns(set);
        follow_period(number_, now_ns);
        return now_ns;
    }
    arrived_ns_ = now_ns;
    number_ += apart;
    follow_period(number_, now_ns);
    taken_ns_ = expected_ns + catch_up(std::max(now_ns - expected_ns, Nanoseconds{0}));
    if (const Nanoseconds early_ns = taken_ns_ - now_ns; early_ns > 0) {
        taken_ns_ = now_ns;
        sets_.shifted_ns += early_ns;
        for (std::size_t i = 0; i < sets_.count; ++i) sets_.list[i].taken_ns -= early_ns;
        if (left_out_) left_out_->taken_ns -= early_ns;
    }
    return taken_ns_;
}

bool GloveTimeline::is_plausible(const TimedSet& timed) noexcept {
    const bool follows = sets_.count > 0 && timed.taken_ns - sets_.newest().taken_ns <= kAstray_ns;
    const bool agrees = left_out_ && !jumps(*left_out_, timed);
    if (!follows || agrees || in_a_row_ >= kMostRejected || !jumps(sets_.newest(), timed)) {
        left_out_.reset();
        in_a_row_ = 0;
        return true;
    }
    left_out_ = timed;
    ++in_a_row_;
    ++sets_.rejected;
    return false;
}

bool GloveTimeline::take(const GloveSet& set, Nanoseconds now_ns) noexcept {
    const TimedSet timed{time_of(set, now_ns), set};
    if (!is_plausible(timed)) return false;
    if (sets_.count > 0) {
        const Nanoseconds needs_ns = now_ns - sets_.newest().taken_ns;
        const Nanoseconds kept_ns = sets_.needs_ns - sets_.needs_ns / kForgetPart;
        if (needs_ns <= kAstray_ns) sets_.needs_ns = std::min(std::max(needs_ns, kept_ns), kMostNeeded_ns);
    }
    if (sets_.count == GloveSets::kKept)
        std::shift_left(sets_.list.begin(), sets_.list.end(), 1);
    else
        ++sets_.count;
    sets_.list[sets_.count - 1] = timed;
    ++sets_.heard;
    return true;
}

}  // namespace burin::devices
