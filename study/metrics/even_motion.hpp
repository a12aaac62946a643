// SPDX-License-Identifier: MIT
// A motion sampled at any times, made even and smooth, so that its figures are those of the hand and not of the
// device's rate or encoder: the same motion read at 250 or 2000 Hz, evenly or not, has the same figures. Times in
// nanoseconds, not falling, as many as points; metres. Pure; any thread; allocates.
//
// Third derivatives multiply noise by the cube of its frequency: without a low-pass the jerk of a hand at a 0.05 mm
// encoder is that of the encoder. The low-pass is a Butterworth filter of second order that runs forth and back, so
// that nothing is delayed, with 3 dB at kMotionCutoff_Hz in all (D. A. Winter, "Biomechanics and Motor Control of Human
// Movement", 2009, chapter 3.4.4: 6 Hz, which keeps what an arm does at will and leaves out tremor and encoder).
#pragma once

#include <span>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"

namespace burin::study {

inline constexpr double kEvenRate_Hz = 1000.0, kMotionCutoff_Hz = 6.0;
// Both ends of a motion lead the filter in: smoothness is that of what lies between.
inline constexpr double kMotionLead_s = 0.1;

// The seconds that each tick stands for: half of the way to the tick before and half of that to the next.
[[nodiscard]] std::vector<double> tick_seconds(std::span<const Nanoseconds> times_ns);

// The mean by weights, or of all alike where these are empty or add up to 0; NaN for no values.
[[nodiscard]] double weighted_mean(std::span<const double> values, std::span<const double> weights);

// Points kEvenRate_Hz apart from the first time to the last, straight between the samples. Of samples at one time the
// last counts. Empty where no time passes or more than kMostEvenSamples would be needed.
[[nodiscard]] std::vector<Vec3> evenly_sampled(std::span<const Vec3> points_m, std::span<const Nanoseconds> times_ns);
inline constexpr std::size_t kMostEvenSamples = std::size_t{1} << 20;  // 17 minutes

// Filters forth and back. Beyond its ends the motion is taken to go on as its mirror image about the end point.
[[nodiscard]] std::vector<Vec3> low_passed(std::span<const Vec3> points_m, double rate_Hz, double cutoff_Hz);

// Figures of the motion after the low-pass. NaN where the motion is too short or a point is not finite.
struct MotionFigures {
    double path_length_m = 0.0;
    double spectral_arc_length = 0.0, dimensionless_jerk = 0.0, log_dimensionless_jerk = 0.0;  // between the leads
};
[[nodiscard]] MotionFigures motion_figures(std::span<const Vec3> points_m, std::span<const Nanoseconds> times_ns);

}  // namespace burin::study
