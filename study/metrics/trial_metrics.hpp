// SPDX-License-Identifier: MIT
// What is measured of one trial: time, deviations from the path, effectiveness, the path itself, smoothness, contact
// and force. Samples are one a tick, at the times that the ticks state, whatever their rate, from the start cap to the
// end cap; vectors are in one frame, metres and newtons. Means are over time. NaN where a measure is not defined. Pure;
// any thread; allocates.
#pragma once

#include <span>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "study/metrics/even_motion.hpp"
#include "study/metrics/path.hpp"

namespace burin::study {

// The mean length of point - collision point over the trial; where the point is inside, they are the same and add 0.
// As many collision points as points; weights are the seconds that each stands for (even_motion.hpp), or empty.
[[nodiscard]] double mean_deviation_m(std::span<const Vec3> points_m, std::span<const Vec3> collision_points_m,
                                      std::span<const double> weights = {});

// Effectiveness in the two forms in which it is in use, both of the two points' mean deviations in the same unit.
// Index: 100 - 100 (D_top + D_bottom); greater is better, 100 is a trial without deviation. The headline.
[[nodiscard]] double effectiveness_index(double deviation_top, double deviation_bottom);
// Cost: E = K1 time + K2 deviation, deviation being the sum of both; less is better.
struct EffectivenessWeights {
    double of_time = 1.0, of_deviation = 1.0;
};
[[nodiscard]] double effectiveness_cost(double time, double deviation, const EffectivenessWeights& weights);

// Contact is a force of more than threshold_N. An episode is a run of ticks in contact; out of contact for less than
// kContactBreak_s does not end it, since a point that grazes a wall would leave it at each step of its encoder. Where
// contact begins or ends between two ticks, half of the time between them counts.
inline constexpr double kContactBreak_s = 0.02;
struct ContactFigures {
    double time_s = 0.0;
    std::size_t episodes = 0;
    double peak_force_N = 0.0;
    double mean_force_N = 0.0;  // over the time in contact; NaN where there is none
};
// As many times as forces, not falling. With a force that is not finite all but the episodes are NaN.
[[nodiscard]] ContactFigures contact_figures(std::span<const Vec3> forces_N, std::span<const Nanoseconds> times_ns,
                                             double threshold_N = 0.0);

// One point of the probe over the trial; all of one length.
struct PointSamples {
    std::span<const Vec3> positions_m, collision_points_m, forces_N;
};

struct PointMetrics {
    double deviation_m = 0.0;
    Distances to_centreline;     // nearest
    Distances along_centreline;  // at the same share of the length
    double frechet_m = 0.0;
    MotionFigures motion;
    double economy = 0.0;  // the centreline's length, by the path's
    ContactFigures contact;
};

struct TrialMetrics {
    double time_s = 0.0;  // between the first and the last sample
    PointMetrics top, bottom;
    double effectiveness_index = 0.0;  // of deviations in mm
    double effectiveness_cost = 0.0;   // of seconds and mm
};

struct TrialSamples {
    std::span<const Nanoseconds> times_ns;  // one for each sample
    PointSamples top, bottom;
    std::span<const Vec3> centreline_m;
};
[[nodiscard]] TrialMetrics measure_trial(const TrialSamples& samples, const EffectivenessWeights& weights = {},
                                         double contact_threshold_N = 0.0);

}  // namespace burin::study
