// SPDX-License-Identifier: MIT
// Head prediction: the head's pose at the time when a picture is shown, from a tracker's samples; and a plausibility
// check of the tracker.
//
// A state and pure functions: take() adds a sample, draw() computes the poses of one frame. No clock, no thread, no
// heap but for the text of a report. Lengths in metres, tracker frame (wall/wall.hpp); times on the process's one clock
// (base/clock.hpp), stamped when the head was measured.
//
// Prediction. The newest sample, extrapolated with the velocity of the samples of the last 25 ms
// (base/pose_motion.hpp has the formulas and the bound on the error). A line over several samples instead of the last
// two costs half of that window and lowers the noise of the slope, which the time ahead multiplies.
// To avoid overshoot, the velocity is kept for 50 ms beyond the newest sample, falls linearly to zero at 100 ms, and
// stays zero: a tracker that stops sending leaves the head at most 75 ms ahead.
//
// Plausibility check. A sample that is not a number, that is farther away than any hall is long (a tracker that reports
// millimetres), that goes back in time or that would need a speed above the limit is not used; prediction goes on from
// the samples before. When kSamplesToTrust samples in a row agree among themselves (a tracker was restarted, or its
// first samples were the wrong ones), they are accepted. After lost_after_ns without a sample the head glides to the
// fallback pose, and back when samples return.
//
// The drawn pose never jumps: whenever the head is lost or found, and whenever the target leaves the last drawn pose by
// more than the speed limit allows for the time passed, the difference is kept as an offset, which then glides to zero.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/clock.hpp"
#include "wall/wall.hpp"

namespace burin::wall {

struct TrackerSample {
    Nanoseconds time_ns = 0;
    Pose sensor_tracker;  // the orientation is normalised by take()
};

struct HeadSettings {
    Pose fallback_tracker{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};
    double farthest_m = 25.0;          // from the fallback pose
    double max_speed_m_per_s = 3.0;    // a brisk walk is 2; faster is a jump
    double max_turn_rad_per_s = 12.0;  // quick head turns reach about 10
    Nanoseconds velocity_window_ns = 25'000'000;
    // How long beyond the newest sample the full velocity is kept.
    Nanoseconds full_prediction_ns = 50'000'000;
    // From when on the velocity is zero.
    Nanoseconds end_of_prediction_ns = 100'000'000;
    Nanoseconds lost_after_ns = 200'000'000;
    double glide_m_per_s = 0.5;
    double glide_rad_per_s = 0.8;
};

// Says how far away something tracked is, what may be wrong, and the remedy: a tracker that reports millimetres as
// metres has everything a thousand times as far away. who: "the head".
[[nodiscard]] std::string too_far_away(const std::string& who, double away_m, double farthest_m);

// Default settings with the setup's fallback pose.
[[nodiscard]] HeadSettings head_settings(const WallSetup& setup);

enum class TrackerState : std::uint8_t {
    waiting,  // no sample yet, not even one that is refused: the fallback pose is drawn
    ok,
    jumped,  // the newest samples are not accepted
    lost,
};

enum class SampleFault : std::uint8_t { none, not_a_number, too_far, back_in_time, too_fast };

// Source of a frame's pose; when it changes the picture glides.
enum class DrawnFrom : std::uint8_t {
    fallback,
    one_sample,  // its velocity is not known yet
    prediction,
};

inline constexpr int kSamplesToTrust = 5;

// State of the prediction: plain data, to be recorded and replayed. Start with {}.
struct HeadTrack {
    static constexpr int kMostSamples = 16;
    std::array<TrackerSample, kMostSamples> samples{};  // the accepted samples, oldest first
    int count = 0;

    TrackerSample pending;  // the newest of a run that is not accepted yet
    int pending_run = 0;
    SampleFault fault = SampleFault::none;  // of the newest sample
    double fault_speed = 0.0;               // m/s, or rad/s when fault_turned
    bool fault_turned = false;
    double fault_back_s = 0.0;
    double fault_away_m = 0.0;  // from the fallback pose, when too_far
    std::uint64_t refused = 0;  // refused samples since the start

    bool drawn_before = false;
    DrawnFrom drawn_from = DrawnFrom::fallback;
    Nanoseconds drawn_ns = 0;  // display time of the later eye
    Pose drawn_tracker;
    // When the offset had the value below; it glides to zero from then on.
    Nanoseconds offset_ns = 0;
    Vec3 offset_m{0.0};
    Vec3 offset_rad{0.0};  // rotation vector
};

// Adds a tracker sample to the state, or counts it as refused.
[[nodiscard]] HeadTrack take(const HeadSettings& settings, HeadTrack track, const TrackerSample& sample);

// The predicted pose at a time, without plausibility check and glide. The track must hold a sample.
[[nodiscard]] Pose predicted(const HeadSettings& settings, const HeadTrack& track, Nanoseconds time_ns);

struct EyeTimes {
    Nanoseconds left_ns = 0, right_ns = 0;
};

// Display times of both eyes, if the first field is shown at first_field_ns (the middle of its scan-out): a
// frame-sequential display shows the second eye one field later, 1 / refresh_Hz.
[[nodiscard]] EyeTimes eye_times(const DisplayTiming& timing, Nanoseconds first_field_ns);

struct DrawnHead {
    HeadTrack track;
    HeadPoses poses;
};

// Computes the head poses of a frame. Call it once a frame, with times that rise from frame to frame.
[[nodiscard]] DrawnHead draw(const HeadSettings& settings, HeadTrack track, const EyeTimes& times);

struct TrackerReport {
    TrackerState state = TrackerState::waiting;
    std::string cause;  // empty when ok
    bool gliding = false;
    double sample_age_s = 0.0;  // at the time given; 0 while waiting
};
// State of the tracker for the log and the panel.
[[nodiscard]] TrackerReport report(const HeadSettings& settings, const HeadTrack& track, Nanoseconds time_ns);

}  // namespace burin::wall
