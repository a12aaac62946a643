// SPDX-License-Identifier: MIT
#include "desk/timing/frame_pacing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace burin::session {
namespace {

constexpr std::size_t kNewest = 4;  // newest frames, whose longest counts
constexpr double kMissGrowth = 1.5, kTimelyShrinking = 0.99;
// Gain of the filter over flips when it has settled.
constexpr double kLeastGain = 0.05;
// Weight of flips that come later than predicted when the filter has settled.
constexpr double kLateWeight = 1.0 / 16;
// Relative difference beyond which the period is relearned.
constexpr double kRateTolerance = 0.08;
constexpr std::uint32_t kMoreAfter = 2, kLessAfter = 30;
constexpr double kRoomForLess = 0.9;
constexpr std::uint32_t kMostInterval = 60;
constexpr std::uint32_t kQueuedAfter = 4, kBlockedAfter = 3;
// Images beside the one that is shown, with the usual three.
constexpr std::uint32_t kQueueLength = 2;

Nanoseconds whole(double t_ns) { return static_cast<Nanoseconds>(std::floor(t_ns + 0.5)); }

Nanoseconds need_ns(const PacingState& state) {
    return expected_work_ns(state) + whole(state.margin_ns) + state.settings.lead_ns;
}

// Returns the number of periods from the known vblank to the first one not before a time, with half a microsecond of
// tolerance for rounding.
std::int64_t periods_until(const PacingState& state, Nanoseconds time_ns) {
    return static_cast<std::int64_t>(
        std::ceil((static_cast<double>(time_ns - state.vblank_ns) - 500.0) / state.period_ns));
}

Nanoseconds vblank(const PacingState& state, std::int64_t periods) {
    return state.vblank_ns + whole(state.vblank_part_ns + static_cast<double>(periods) * state.period_ns);
}

void choose_interval(PacingState& state) {
    const auto periods = [&](double share) {
        const double wanted = std::ceil(static_cast<double>(need_ns(state)) / (share * state.period_ns) - 1e-6);
        return static_cast<std::uint32_t>(std::clamp(wanted, 1.0, static_cast<double>(kMostInterval)));
    };
    state.frames_wanting_more = periods(1.0) > state.interval ? state.frames_wanting_more + 1 : 0;
    state.frames_wanting_less = periods(kRoomForLess) < state.interval ? state.frames_wanting_less + 1 : 0;
    if (state.frames_wanting_more >= kMoreAfter) {
        state.interval = periods(1.0);
        state.frames_wanting_more = 0;
        state.flip_distance_count = 0;
    }
    if (state.frames_wanting_less >= kLessAfter) {
        state.interval = periods(kRoomForLess);
        state.frames_wanting_less = 0;
        state.flip_distance_count = 0;
    }
}

// Returns the first vblank that the work can reach, and not before the previous frame has lasted its interval.
Nanoseconds next_vblank(const PacingState& state, Nanoseconds now_ns) {
    std::int64_t at = periods_until(state, now_ns + need_ns(state));
    if (state.last_plan.frame > 0) {
        const auto after = static_cast<double>(state.interval + state.periods_to_leave_out);
        at = std::max(at, periods_until(state, state.last_plan.display_ns + whole((after - 0.5) * state.period_ns)));
    }
    return vblank(state, at);
}

// Returns the next frame's time without a display to wait for.
Nanoseconds next_free_time(const PacingState& state, Nanoseconds now_ns) {
    const Nanoseconds soonest_ns = now_ns + need_ns(state);
    if (state.last_plan.frame == 0) return soonest_ns;
    return std::max(soonest_ns, state.last_plan.display_ns + whole(state.period_ns));
}

void restart_flips(PacingState& state, Nanoseconds flip_ns) {
    state.flips_seen = true;
    state.vblank_ns = flip_ns;
    state.vblank_part_ns = 0.0;
    state.flips_since_reset = 1;
    state.flip_distance_count = 0;
    state.queued_frames = state.blocked_frames = 0;
}

// Returns whether the distances of flips show another period, and adopts it.
bool rate_has_changed(PacingState& state) {
    if (state.flip_distance_count < state.flip_distances_ns.size()) return false;
    auto sorted = state.flip_distances_ns;
    std::ranges::sort(sorted);
    const Nanoseconds median_ns = sorted[sorted.size() / 2];
    state.flip_distance_count = 0;
    const double ratio = static_cast<double>(median_ns) / state.period_ns;
    if (std::abs(ratio - 1.0) < kRateTolerance || median_ns < 1'000'000) return false;
    state.period_ns = static_cast<double>(median_ns);
    ++state.period_resets;
    return true;
}

void follow_flip(PacingState& state, Nanoseconds flip_ns) {
    const auto since = static_cast<double>(flip_ns - state.vblank_ns) - state.vblank_part_ns;
    const double periods = std::round(since / state.period_ns);
    if (periods <= 0.0) return;  // an old flip
    const double error_ns = since - periods * state.period_ns;
    const double n = static_cast<double>(state.flips_since_reset++);
    // While the filter settles, the gains are those of a straight line through the n + 1 flips so far.
    const double alpha = std::max(kLeastGain, 2.0 * (2.0 * n + 1.0) / ((n + 1.0) * (n + 2.0)));
    const double beta = std::max(kLeastGain * kLeastGain / (2.0 - kLeastGain), 6.0 / ((n + 1.0) * (n + 2.0)));
    // A single flip gives a phase, not a rate: the initial period is trusted more than the first distances.
    const double trusted = n < 8.0 ? kLeastGain * kLeastGain : beta;
    const double weighed_ns = (n >= 32.0 && error_ns > 0.0 ? kLateWeight : 1.0) * error_ns;
    state.period_ns += std::min(beta, trusted) * weighed_ns / periods;
    const double at_ns = state.vblank_part_ns + since - error_ns + std::min(alpha, 1.0) * weighed_ns;
    const double whole_ns = std::floor(at_ns);
    state.vblank_ns += static_cast<Nanoseconds>(whole_ns);
    state.vblank_part_ns = at_ns - whole_ns;
}

void learn_display(PacingState& state, const FrameMeasure& m, bool in_time) {
    if (!m.flip_ns) return;
    const Nanoseconds flip_ns = *m.flip_ns;
    const bool first = !state.flips_seen;
    if (first) restart_flips(state, flip_ns);
    if (!first && in_time && flip_ns > state.last_flip_ns && m.plan.interval == state.interval &&
        state.periods_to_leave_out == 0)
        state.flip_distances_ns[state.flip_distance_count++ % state.flip_distances_ns.size()] =
            (flip_ns - state.last_flip_ns) / m.plan.interval;
    if (!first && rate_has_changed(state))
        restart_flips(state, flip_ns);
    else if (!first)
        follow_flip(state, flip_ns);
    state.last_flip_ns = std::max(state.last_flip_ns, flip_ns);
}

void learn_work(PacingState& state, const FrameMeasure& m) {
    const Nanoseconds total_ns = std::max<Nanoseconds>(m.finished_ns - m.plan.wake_ns, 0);
    state.work_ns[state.work_count++ % state.work_ns.size()] = total_ns;
}

void adapt_margin(PacingState& state, bool in_time) {
    state.margin_ns *= in_time ? kTimelyShrinking : kMissGrowth;
    const auto most = std::min(static_cast<double>(state.settings.most_margin_ns), 0.5 * state.period_ns);
    state.margin_ns =
        std::clamp(state.margin_ns, std::min(static_cast<double>(state.settings.least_margin_ns), most), most);
}

void empty_queue(PacingState& state, const FrameMeasure& m, bool in_time, bool missed) {
    state.queued_frames = m.displayed_ns && in_time && missed ? state.queued_frames + 1 : 0;
    const bool blocked = 2.0 * static_cast<double>(m.blocked_ns) > state.period_ns;
    state.blocked_frames = blocked ? state.blocked_frames + 1 : 0;
    if (state.queued_frames >= kQueuedAfter) state.periods_to_leave_out = 1;
    if (state.blocked_frames >= kBlockedAfter) state.periods_to_leave_out = kQueueLength;
    if (state.periods_to_leave_out > 0) state.queued_frames = state.blocked_frames = 0;
}

// Returns when the frame was shown or, where that is not reported, must have been.
Nanoseconds shown_ns(const PacingState& state, const FrameMeasure& m) {
    if (m.displayed_ns) return *m.displayed_ns;
    const Nanoseconds ready_ns = m.finished_ns + state.settings.lead_ns;
    if (!state.flips_seen) return ready_ns;
    return std::max(m.plan.display_ns, vblank(state, periods_until(state, ready_ns)));
}

}  // namespace

PacingState begin_pacing(const PacingSettings& settings) {
    BURIN_CHECK(settings.period_ns > 0 && settings.least_margin_ns >= 0 && settings.lead_ns >= 0 &&
                settings.most_margin_ns >= settings.least_margin_ns);
    PacingState state;
    state.settings = settings;
    state.period_ns = static_cast<double>(settings.period_ns);
    state.margin_ns = static_cast<double>(settings.least_margin_ns);
    return state;
}

Nanoseconds expected_work_ns(const PacingState& state) {
    const std::size_t size = state.work_ns.size();
    const std::size_t count = std::min<std::uint64_t>(state.work_count, size);
    Nanoseconds longest = 0, second = 0, newest = 0;
    for (std::size_t back = 0; back < count; ++back) {
        const Nanoseconds w = state.work_ns[(state.work_count - 1 - back) % size];
        if (w > longest)
            second = std::exchange(longest, w);
        else
            second = std::max(second, w);
        if (back < kNewest) newest = longest;
    }
    return std::max(newest, second);
}

PlannedFrame plan_frame(PacingState state, Nanoseconds now_ns) {
    choose_interval(state);
    FramePlan plan;
    plan.frame = state.last_plan.frame + 1;
    plan.interval = state.flips_seen ? state.interval : 1;
    plan.display_ns = state.flips_seen ? next_vblank(state, now_ns) : next_free_time(state, now_ns);
    plan.finish_by_ns = plan.display_ns - state.settings.lead_ns;
    plan.wake_ns = std::max(now_ns, plan.display_ns - need_ns(state));
    if (state.flips_seen) state.left_out += state.periods_to_leave_out;
    state.periods_to_leave_out = 0;
    state.last_plan = plan;
    return {state, plan};
}

PacingState frame_finished(PacingState state, const FramePlan& plan, Nanoseconds finished_ns) {
    if (plan.frame != state.last_plan.frame) return state;
    const Nanoseconds ready_ns = finished_ns + state.settings.lead_ns;
    // Without vblanks, a frame that finished much earlier than expected must not hold up the next.
    const bool early = !state.flips_seen && ready_ns + whole(state.period_ns) < plan.display_ns;
    if (finished_ns <= plan.finish_by_ns && !early) return state;
    state.last_plan.display_ns = state.flips_seen ? vblank(state, periods_until(state, ready_ns)) : ready_ns;
    return state;
}

PacingState after_frame(PacingState state, const FrameMeasure& measure) {
    const bool in_time = measure.finished_ns <= measure.plan.finish_by_ns;
    learn_display(state, measure, in_time);
    learn_work(state, measure);
    const Nanoseconds shown = shown_ns(state, measure);
    const bool missed = 2.0 * static_cast<double>(shown - measure.plan.display_ns) > state.period_ns;
    adapt_margin(state, in_time && (!missed || state.last_missed));  // a repeated miss is the queue's
    state.last_missed = missed;
    empty_queue(state, measure, in_time, missed);
    ++state.measured;
    if (missed) ++state.missed;
    state.head_age_ns = shown - measure.sampled_ns;
    return state;
}

PacingState display_changed(PacingState state, Nanoseconds period_ns) {
    BURIN_CHECK(period_ns > 0);
    state.settings.period_ns = period_ns;
    state.period_ns = static_cast<double>(period_ns);
    state.flips_seen = false;
    state.flip_distance_count = 0;
    state.interval = 1;
    ++state.period_resets;
    return state;
}

}  // namespace burin::session
