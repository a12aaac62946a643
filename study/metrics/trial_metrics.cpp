// SPDX-License-Identifier: MIT
#include "study/metrics/trial_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "study/metrics/smoothness.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {
namespace {

PointMetrics measure_point(const PointSamples& samples, std::span<const Vec3> centreline_m, double rate_hz,
                           double threshold_N) {
    const std::vector<double> speeds = speeds_m_per_s(samples.positions_m, rate_hz);
    return {.deviation_m = mean_deviation_m(samples.positions_m, samples.collision_points_m),
            .to_centreline = distances_to_centreline(samples.positions_m, centreline_m),
            .along_centreline = arc_length_matched(samples.positions_m, centreline_m),
            .frechet_m = frechet_distance_m(samples.positions_m, centreline_m),
            .path_length_m = path_length_m(samples.positions_m),
            .economy = economy_of_path(samples.positions_m, path_length_m(centreline_m)),
            .spectral_arc_length = spectral_arc_length(speeds, rate_hz),
            .dimensionless_jerk = dimensionless_jerk(speeds, rate_hz),
            .log_dimensionless_jerk = log_dimensionless_jerk(speeds, rate_hz),
            .contact = contact_figures(samples.forces_N, rate_hz, threshold_N)};
}

}  // namespace

double mean_deviation_m(std::span<const Vec3> points_m, std::span<const Vec3> collision_points_m) {
    BURIN_CHECK(points_m.size() == collision_points_m.size());
    const std::size_t n = std::min(points_m.size(), collision_points_m.size());
    if (n == 0) return kUndefined;
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += glm::distance(points_m[i], collision_points_m[i]);
    return sum / static_cast<double>(n);
}

double effectiveness_index(double deviation_top, double deviation_bottom) {
    return 100.0 - 100.0 * (deviation_top + deviation_bottom);
}

double effectiveness_cost(double time, double deviation, const EffectivenessWeights& weights) {
    return weights.of_time * time + weights.of_deviation * deviation;
}

ContactFigures contact_figures(std::span<const Vec3> forces_N, double rate_hz, double threshold_N) {
    ContactFigures figures;
    std::size_t ticks = 0;
    double sum_N = 0.0;
    bool in_contact = false;
    for (const Vec3& force : forces_N) {
        const double size_N = glm::length(force);
        if (!std::isfinite(size_N)) return {kUndefined, figures.episodes, kUndefined, kUndefined};
        const bool touches = size_N > threshold_N;
        if (touches) {
            ++ticks;
            sum_N += size_N;
            figures.peak_force_N = std::max(figures.peak_force_N, size_N);
            if (!in_contact) ++figures.episodes;
        }
        in_contact = touches;
    }
    figures.time_s = rate_hz > 0.0 ? static_cast<double>(ticks) / rate_hz : kUndefined;
    figures.mean_force_N = ticks > 0 ? sum_N / static_cast<double>(ticks) : kUndefined;
    return figures;
}

TrialMetrics measure_trial(const TrialSamples& samples, const EffectivenessWeights& weights,
                           double contact_threshold_N) {
    const std::size_t ticks = samples.top.positions_m.size();
    TrialMetrics metrics;
    metrics.time_s = ticks > 0 && samples.rate_hz > 0.0 ? static_cast<double>(ticks - 1) / samples.rate_hz : kUndefined;
    metrics.top = measure_point(samples.top, samples.centreline_m, samples.rate_hz, contact_threshold_N);
    metrics.bottom = measure_point(samples.bottom, samples.centreline_m, samples.rate_hz, contact_threshold_N);
    const double top_mm = 1000.0 * metrics.top.deviation_m, bottom_mm = 1000.0 * metrics.bottom.deviation_m;
    metrics.effectiveness_index = effectiveness_index(top_mm, bottom_mm);
    metrics.effectiveness_cost = effectiveness_cost(metrics.time_s, top_mm + bottom_mm, weights);
    return metrics;
}

}  // namespace burin::study
