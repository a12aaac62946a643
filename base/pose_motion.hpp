// SPDX-License-Identifier: MIT
// The velocity of a body from its newest poses, and where it is a little later: for heads and wands whose poses are
// late.
//
// Position: the slope of the least-squares line through the newest samples. Orientation: likewise of the rotation
// vectors log(q_i q_newest^-1), whose slope is the angular velocity in the frame of the poses; q = exp(w t) q_newest.
// Uniform motion and uniform turning are exact. For a motion with acceleration at most a, samples at even times over a
// window W and a time T ahead: the slope is the velocity W/2 ago to within a W/2, so the error is at most
// a T (T + W) / 2.
// Units: metres, radians, seconds; times in nanoseconds on one clock. Pure; any thread; no heap.
#pragma once

#include <span>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin {

struct TimedPose {
    Nanoseconds time_ns = 0;
    Pose pose;  // orientation of length 1
};

// Says which samples a velocity is computed from, and bounds it.
struct VelocityWindow {
    Nanoseconds window_ns = 25'000'000;
    // Two samples of a slow tracker are used even outside the window, unless older than this.
    Nanoseconds oldest_ns = 100'000'000;
    double max_speed_m_per_s = 3.0;    // a brisk walk is 2
    double max_turn_rad_per_s = 12.0;  // quick head turns reach about 10
};

struct PoseVelocity {
    bool known = false;  // two samples at least
    Vec3 m_per_s{0.0}, rad_per_s{0.0};
};

// samples: oldest first, with rising times.
[[nodiscard]] PoseVelocity velocity_of(const VelocityWindow& window, std::span<const TimedPose> samples);
// Returns the pose after so many seconds at that velocity.
[[nodiscard]] Pose moved(const Pose& pose, const PoseVelocity& velocity, double ahead_s);

// Axis times angle, the shorter way round; and back.
[[nodiscard]] Vec3 rotation_vector(const Quat& rotation);
[[nodiscard]] Quat rotation_by(const Vec3& vector_rad);
[[nodiscard]] Vec3 rotation_vector_between(const Quat& from, const Quat& to);

// Shortens a vector to a length where it is longer.
[[nodiscard]] Vec3 at_most(const Vec3& v, double length);

}  // namespace burin
