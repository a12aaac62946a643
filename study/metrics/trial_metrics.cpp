// SPDX-License-Identifier: MIT
#include "study/metrics/trial_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {
namespace {

PointMetrics measure_point(const PointSamples& samples, const TrialSamples& trial, std::span<const double> weights,
                           double threshold_N) {
    PointMetrics metrics{.deviation_m = mean_deviation_m(samples.positions_m, samples.collision_points_m, weights),
                         .to_centreline = distances_to_centreline(samples.positions_m, trial.centreline_m, weights),
                         .along_centreline = arc_length_matched(samples.positions_m, trial.centreline_m),
                         .frechet_m = frechet_distance_m(samples.positions_m, trial.centreline_m),
                         .motion = motion_figures(samples.positions_m, trial.times_ns),
                         .contact = contact_figures(samples.forces_N, trial.times_ns, threshold_N)};
    metrics.economy = path_length_m(trial.centreline_m) / metrics.motion.path_length_m;
    return metrics;
}

}  // namespace

double mean_deviation_m(std::span<const Vec3> points_m, std::span<const Vec3> collision_points_m,
                        std::span<const double> weights) {
    BURIN_CHECK(points_m.size() == collision_points_m.size());
    std::vector<double> lengths;
    for (std::size_t i = 0; i < std::min(points_m.size(), collision_points_m.size()); ++i)
        lengths.push_back(glm::distance(points_m[i], collision_points_m[i]));
    return weighted_mean(lengths, weights);
}

double effectiveness_index(double deviation_top, double deviation_bottom) {
    return 100.0 - 100.0 * (deviation_top + deviation_bottom);
}

double effectiveness_cost(double time, double deviation, const EffectivenessWeights& weights) {
    return weights.of_time * time + weights.of_deviation * deviation;
}

ContactFigures contact_figures(std::span<const Vec3> forces_N, std::span<const Nanoseconds> times_ns,
                               double threshold_N) {
    BURIN_CHECK(forces_N.size() == times_ns.size());
    ContactFigures figures;
    const std::vector<double> stands_for_s = tick_seconds(times_ns);
    double sum_Ns = 0.0;
    std::optional<Nanoseconds> touched_ns;  // last
    for (std::size_t i = 0; i < std::min(forces_N.size(), stands_for_s.size()); ++i) {
        const double size_N = glm::length(forces_N[i]);
        if (!std::isfinite(size_N)) return {kUndefined, figures.episodes, kUndefined, kUndefined};
        if (size_N > threshold_N) {
            figures.time_s += stands_for_s[i];
            sum_Ns += stands_for_s[i] * size_N;
            figures.peak_force_N = std::max(figures.peak_force_N, size_N);
            if (!touched_ns || seconds(times_ns[i] - *touched_ns) > kContactBreak_s) ++figures.episodes;
            touched_ns = times_ns[i];
        }
    }
    figures.mean_force_N = figures.time_s > 0.0 ? sum_Ns / figures.time_s : kUndefined;
    return figures;
}

TrialMetrics measure_trial(const TrialSamples& samples, const EffectivenessWeights& weights,
                           double contact_threshold_N) {
    TrialMetrics metrics;
    metrics.time_s =
        samples.times_ns.empty() ? kUndefined : seconds(samples.times_ns.back() - samples.times_ns.front());
    const std::vector<double> stand_for_s = tick_seconds(samples.times_ns);
    metrics.top = measure_point(samples.top, samples, stand_for_s, contact_threshold_N);
    metrics.bottom = measure_point(samples.bottom, samples, stand_for_s, contact_threshold_N);
    const double top_mm = 1000.0 * metrics.top.deviation_m, bottom_mm = 1000.0 * metrics.bottom.deviation_m;
    metrics.effectiveness_index = effectiveness_index(top_mm, bottom_mm);
    metrics.effectiveness_cost = effectiveness_cost(metrics.time_s, top_mm + bottom_mm, weights);
    return metrics;
}

}  // namespace burin::study
