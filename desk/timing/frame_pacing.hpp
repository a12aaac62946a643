// SPDX-License-Identifier: MIT
// Plans when to wake for the next frame so that its head is sampled as late as possible and its picture is still in
// time for the display. A pure helper: all times are passed in; it neither waits nor asks a window system.
//
//   wake -- work: processor, then graphics ----| margin | lead | display
//
// Each frame: plan_frame(), sleep until plan.wake_ns, sample the head for plan.display_ns, draw, present,
// frame_finished(); and when the frame's measures are known, some frames later where need be, after_frame().
//
// Estimated from the measures:
//   work      from the planned wake-up to the finished picture, oversleeping included. The plan takes the longest of
//             the last four frames and the second longest of the last 32: a jump is met at once, a single hitch is soon
//             forgotten.
//   margin    grows by half when a frame is missed, shrinks by a hundredth when one is in time.
//   vblank    the display's phase and period, by an alpha-beta filter (Benedict and Bordner 1962) over the flips that
//             are seen, so that clocks and schedulers may be milliseconds off. Flips are seen late, never early, so
//             early ones weigh more. A period that is wrong by more than 8 % shows in the distances of flips and is
//             taken from their median. Without any flip (a display that does not throttle: Xvfb) frames are planned one
//             period apart, or as fast as the work allows.
//   interval  how many periods a frame lasts. It grows when two frames in a row need more, and shrinks when thirty did
//             not need nine tenths of what a shorter one gives. So a load of about a period does not make the rate
//             flutter between two values.
//   queue     frames that were in time and yet are seen a period late have others before them in the swapchain's queue,
//             and blocking means that it is full: one period is skipped so that it empties, two
//             after blocking.
// Units: nanoseconds on one monotonic clock. Any thread; no heap.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/clock.hpp"

namespace burin::session {

struct PacingSettings {
    // Period until flips are seen: from the monitor's mode. For frame-sequential stereo the period of a pair of fields.
    Nanoseconds period_ns = 16'666'667;
    Nanoseconds least_margin_ns = 500'000;
    Nanoseconds most_margin_ns = 6'000'000;
    Nanoseconds lead_ns = 500'000;  // a picture finished less than this before a vblank misses it
};

struct FramePlan {
    std::uint64_t frame = 0;
    Nanoseconds wake_ns = 0;       // not before the time of planning
    Nanoseconds finish_by_ns = 0;  // the picture must be finished by then
    Nanoseconds display_ns = 0;    // when it is first seen
    std::uint32_t interval = 1;    // periods it lasts
};

// Measured outcome of a plan.
struct FrameMeasure {
    FramePlan plan;
    Nanoseconds sampled_ns = 0;   // when the head that it shows was sampled
    Nanoseconds finished_ns = 0;  // the processor's and the graphics device's work was done
    Nanoseconds blocked_ns = 0;   // acquire and present waited for the display
    // A vblank that was seen: by a present that was waited for, a vblank counter, or the return of a call that blocked.
    std::optional<Nanoseconds> flip_ns;
    // When this very frame was first shown, where the window system reports it.
    std::optional<Nanoseconds> displayed_ns;
};

struct PacingState {
    PacingSettings settings;
    double period_ns = 0.0;
    // The display, where flips are seen.
    bool flips_seen = false;
    Nanoseconds vblank_ns = 0;  // time of one vblank
    // Fraction of vblank_ns below a nanosecond, so that small corrections add up.
    double vblank_part_ns = 0.0;
    std::uint32_t flips_since_reset = 0;
    Nanoseconds last_flip_ns = 0;
    std::array<Nanoseconds, 12> flip_distances_ns{};  // per period of the interval, of frames that were in time
    std::uint32_t flip_distance_count = 0;
    // The work.
    std::array<Nanoseconds, 32> work_ns{};  // a ring; work_count says how many are valid
    std::uint64_t work_count = 0;
    double margin_ns = 0.0;
    // The rate.
    std::uint32_t interval = 1;
    std::uint32_t frames_wanting_more = 0, frames_wanting_less = 0;
    std::uint32_t queued_frames = 0, blocked_frames = 0;  // in a row
    bool last_missed = false;
    std::uint32_t periods_to_leave_out = 0;
    FramePlan last_plan;
    // Figures.
    std::uint64_t measured = 0;
    std::uint64_t missed = 0;         // shown later than planned by more than half a period
    std::uint64_t left_out = 0;       // periods skipped to empty the queue
    Nanoseconds head_age_ns = 0;      // of the newest measured frame, when it was (or must have been) shown
    std::uint64_t period_resets = 0;  // the display's rate changed
};

[[nodiscard]] PacingState begin_pacing(const PacingSettings& settings);

struct PlannedFrame {
    PacingState state;
    FramePlan plan;
};
[[nodiscard]] PlannedFrame plan_frame(PacingState state, Nanoseconds now_ns);

// Reports when the newest frame's picture was finished, as soon as it is known, best before the next plan. A late
// picture is shown a vblank or more later than planned, and the next frame must not queue up behind it. Without flips,
// one that took much less than expected is shown so much earlier.
[[nodiscard]] PacingState frame_finished(PacingState state, const FramePlan& plan, Nanoseconds finished_ns);

// Applies a frame's measures, when all are known that will be. Call it in the order of frames.
[[nodiscard]] PacingState after_frame(PacingState state, const FrameMeasure& measure);

// Relearns phase and period after the window has moved to another monitor or the mode has changed. (A display that runs
// at a multiple of its former rate shows the same flips to a program that draws at the former.)
[[nodiscard]] PacingState display_changed(PacingState state, Nanoseconds period_ns);

// Returns the time planned for a frame's work, without margin and lead.
[[nodiscard]] Nanoseconds expected_work_ns(const PacingState& state);

}  // namespace burin::session
