// SPDX-License-Identifier: MIT
// What is measured of one trial: time, deviations from the path, effectiveness, the path itself, smoothness, contact
// and force. Samples are one a tick, at equal intervals, from the start cap to the end cap; vectors are in one frame,
// metres and newtons. NaN where a measure is not defined. Pure; any thread; allocates.
#pragma once

#include <span>

#include "base/space.hpp"
#include "study/metrics/path.hpp"

namespace burin::study {

// The mean length of point - collision point over the trial; where the point is inside, they are the same and add 0.
// As many collision points as points.
[[nodiscard]] double mean_deviation_m(std::span<const Vec3> points_m, std::span<const Vec3> collision_points_m);

// Effectiveness in the two forms in which it is in use, both of the two points' mean deviations in the same unit.
// Index: 100 - 100 (D_top + D_bottom); greater is better, 100 is a trial without deviation. The headline.
[[nodiscard]] double effectiveness_index(double deviation_top, double deviation_bottom);
// Cost: E = K1 time + K2 deviation, deviation being the sum of both; less is better.
struct EffectivenessWeights {
    double of_time = 1.0, of_deviation = 1.0;
};
[[nodiscard]] double effectiveness_cost(double time, double deviation, const EffectivenessWeights& weights);

// Contact is a force of more than threshold_N. An episode is an unbroken run of ticks in contact.
struct ContactFigures {
    double time_s = 0.0;
    std::size_t episodes = 0;
    double peak_force_N = 0.0;
    double mean_force_N = 0.0;  // over the ticks in contact; NaN where there is none
};
// With a force that is not finite all but the episodes are NaN.
[[nodiscard]] ContactFigures contact_figures(std::span<const Vec3> forces_N, double rate_hz, double threshold_N = 0.0);

// One point of the probe over the trial; all of one length.
struct PointSamples {
    std::span<const Vec3> positions_m, collision_points_m, forces_N;
};

struct PointMetrics {
    double deviation_m = 0.0;
    Distances to_centreline;     // nearest
    Distances along_centreline;  // at the same share of the length
    double frechet_m = 0.0;
    double path_length_m = 0.0;
    double economy = 0.0;  // the centreline's length, by the path's
    double spectral_arc_length = 0.0, dimensionless_jerk = 0.0, log_dimensionless_jerk = 0.0;
    ContactFigures contact;
};

struct TrialMetrics {
    double time_s = 0.0;  // between the first and the last sample
    PointMetrics top, bottom;
    double effectiveness_index = 0.0;  // of deviations in mm
    double effectiveness_cost = 0.0;   // of seconds and mm
};

struct TrialSamples {
    double rate_hz = 1000.0;
    PointSamples top, bottom;
    std::span<const Vec3> centreline_m;
};
[[nodiscard]] TrialMetrics measure_trial(const TrialSamples& samples, const EffectivenessWeights& weights = {},
                                         double contact_threshold_N = 0.0);

}  // namespace burin::study
