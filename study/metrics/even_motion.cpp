// SPDX-License-Identifier: MIT
#include "study/metrics/even_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "study/metrics/path.hpp"
#include "study/metrics/smoothness.hpp"
#include "study/statistics/outcome.hpp"

namespace burin::study {
namespace {

constexpr Nanoseconds kEvenStep_ns = static_cast<Nanoseconds>(1e9 / kEvenRate_Hz);
constexpr double kMirrored_s = 0.5;  // beyond each end: the filter has forgotten how it began

// A Butterworth filter of second order by the bilinear transform.
class SecondOrder {
public:
    SecondOrder(double rate_Hz, double cutoff_Hz) {
        const double k = std::tan(std::numbers::pi * cutoff_Hz / rate_Hz);
        const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * k + k * k);
        b0_ = k * k * scale;
        a1_ = 2.0 * (k * k - 1.0) * scale;
        a2_ = (1.0 - std::numbers::sqrt2 * k + k * k) * scale;
    }

    // As if the first point had been there for ever.
    void run(std::vector<Vec3>& points) const {
        if (points.empty()) return;
        const Vec3 rest = points.front();
        Vec3 x1{0.0}, x2{0.0}, y1{0.0}, y2{0.0};
        for (Vec3& point : points) {
            const Vec3 x = point - rest;
            const Vec3 y = b0_ * (x + 2.0 * x1 + x2) - a1_ * y1 - a2_ * y2;
            x2 = x1;
            x1 = x;
            y2 = y1;
            y1 = y;
            point = rest + y;
        }
    }

private:
    double b0_ = 0.0, a1_ = 0.0, a2_ = 0.0;
};

// The points with their mirror image about each end point before and behind them.
std::vector<Vec3> mirrored_beyond(std::span<const Vec3> points, std::size_t beyond) {
    std::vector<Vec3> longer;
    longer.reserve(points.size() + 2 * beyond);
    for (std::size_t i = beyond; i > 0; --i) longer.push_back(2.0 * points.front() - points[i]);
    longer.insert(longer.end(), points.begin(), points.end());
    for (std::size_t i = 1; i <= beyond; ++i) longer.push_back(2.0 * points.back() - points[points.size() - 1 - i]);
    return longer;
}

bool all_points_finite(std::span<const Vec3> points) {
    return std::ranges::all_of(points, [](const Vec3& p) { return finite(p); });
}

}  // namespace

std::vector<double> tick_seconds(std::span<const Nanoseconds> times_ns) {
    std::vector<double> stands_for(times_ns.size(), 0.0);
    for (std::size_t i = 1; i < times_ns.size(); ++i) {
        const double half_s = 0.5 * seconds(times_ns[i] - times_ns[i - 1]);
        stands_for[i - 1] += half_s;
        stands_for[i] += half_s;
    }
    return stands_for;
}

double weighted_mean(std::span<const double> values, std::span<const double> weights) {
    if (values.empty()) return kUndefined;
    BURIN_CHECK(weights.empty() || weights.size() == values.size());
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(all > 0.0)) return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    return std::inner_product(values.begin(), values.end(), weights.begin(), 0.0) / all;
}

std::vector<Vec3> evenly_sampled(std::span<const Vec3> points_m, std::span<const Nanoseconds> times_ns) {
    BURIN_CHECK(points_m.size() == times_ns.size());
    std::vector<Vec3> even;
    if (times_ns.empty() || !std::ranges::is_sorted(times_ns)) return even;
    const Nanoseconds long_ns = times_ns.back() - times_ns.front();
    const auto steps = static_cast<std::size_t>(long_ns / kEvenStep_ns);
    if (long_ns <= 0 || steps >= kMostEvenSamples) return even;
    std::size_t next = 0;  // the first sample behind the place
    for (std::size_t k = 0; k <= steps; ++k) {
        const Nanoseconds at_ns = times_ns.front() + static_cast<Nanoseconds>(k) * kEvenStep_ns;
        while (next < times_ns.size() && times_ns[next] <= at_ns) ++next;
        if (next == times_ns.size()) {
            even.push_back(points_m.back());
            continue;
        }
        const double between = seconds(times_ns[next] - times_ns[next - 1]);
        const double share = seconds(at_ns - times_ns[next - 1]) / between;
        even.push_back(points_m[next - 1] + share * (points_m[next] - points_m[next - 1]));
    }
    return even;
}

std::vector<Vec3> low_passed(std::span<const Vec3> points_m, double rate_Hz, double cutoff_Hz) {
    if (points_m.empty()) return {};
    // Two runs have 3 dB together where each has 1.5.
    const SecondOrder filter(rate_Hz, cutoff_Hz / std::pow(std::numbers::sqrt2 - 1.0, 0.25));
    const std::size_t beyond = std::min(points_m.size() - 1, static_cast<std::size_t>(kMirrored_s * rate_Hz));
    std::vector<Vec3> filtered = mirrored_beyond(points_m, beyond);
    filter.run(filtered);
    std::ranges::reverse(filtered);
    filter.run(filtered);
    std::ranges::reverse(filtered);
    const auto first = filtered.begin() + static_cast<std::ptrdiff_t>(beyond);
    return {first, first + std::ssize(points_m)};
}

MotionFigures motion_figures(std::span<const Vec3> points_m, std::span<const Nanoseconds> times_ns) {
    constexpr MotionFigures kNone{kUndefined, kUndefined, kUndefined, kUndefined};
    if (!all_points_finite(points_m)) return kNone;
    const std::vector<Vec3> even = low_passed(evenly_sampled(points_m, times_ns), kEvenRate_Hz, kMotionCutoff_Hz);
    if (even.empty()) return kNone;
    MotionFigures figures = kNone;
    figures.path_length_m = path_length_m(even);
    constexpr auto kLead = static_cast<std::size_t>(kMotionLead_s * kEvenRate_Hz);
    if (even.size() < 4 * kLead) return figures;
    const std::vector<double> speeds =
        speeds_m_per_s(std::span(even).subspan(kLead, even.size() - 2 * kLead), kEvenRate_Hz);
    figures.spectral_arc_length = spectral_arc_length(speeds, kEvenRate_Hz);
    figures.dimensionless_jerk = dimensionless_jerk(speeds, kEvenRate_Hz);
    figures.log_dimensionless_jerk = log_dimensionless_jerk(speeds, kEvenRate_Hz);
    return figures;
}

}  // namespace burin::study
