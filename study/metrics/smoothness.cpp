// SPDX-License-Identifier: MIT
#include "study/metrics/smoothness.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "study/statistics/outcome.hpp"

namespace burin::study {
namespace {

using Complex = std::complex<double>;

// The discrete Fourier transform in place; the length is a power of two (Cooley and Tukey, 1965).
void transform(std::vector<Complex>& values) {
    const std::size_t n = values.size();
    for (std::size_t i = 1, reversed = 0; i < n; ++i) {
        std::size_t bit = n >> 1;
        for (; (reversed & bit) != 0; bit >>= 1) reversed ^= bit;
        reversed |= bit;
        if (i < reversed) std::swap(values[i], values[reversed]);
    }
    // Each root from sine and cosine, so that errors do not build up along the table.
    std::vector<Complex> roots(n / 2);
    for (std::size_t i = 0; i < roots.size(); ++i)
        roots[i] = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    for (std::size_t length = 2; length <= n; length *= 2) {
        const std::size_t half = length / 2, stride = n / length;
        for (std::size_t first = 0; first < n; first += length) {
            for (std::size_t i = 0; i < half; ++i) {
                const Complex even = values[first + i], odd = values[first + i + half] * roots[i * stride];
                values[first + i] = even + odd;
                values[first + i + half] = even - odd;
            }
        }
    }
}

// Amplitudes of all frequencies of the padded profile, divided by the largest.
std::vector<double> spectrum(std::span<const double> speeds, unsigned padding) {
    std::vector<Complex> values(std::bit_ceil(speeds.size()) << padding);
    std::ranges::copy(speeds, values.begin());
    transform(values);
    std::vector<double> amplitudes;
    amplitudes.reserve(values.size());
    for (const Complex& value : values) amplitudes.push_back(std::abs(value));
    const double largest = std::ranges::max(amplitudes);
    for (double& amplitude : amplitudes) amplitude /= largest;
    return amplitudes;
}

bool is_profile(std::span<const double> speeds, double rate_hz) {
    return speeds.size() >= 3 && rate_hz > 0.0 && std::isfinite(rate_hz) && all_finite(speeds) &&
           std::ranges::any_of(speeds, [](double speed) { return speed != 0.0; });
}

}  // namespace

std::vector<double> speeds_m_per_s(std::span<const Vec3> positions_m, double rate_hz) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < positions_m.size(); ++i)
        speeds.push_back(glm::distance(positions_m[i], positions_m[i - 1]) * rate_hz);
    return speeds;
}

double spectral_arc_length(std::span<const double> speeds, double rate_hz, const SpectrumOptions& options) {
    if (!is_profile(speeds, rate_hz) || speeds.size() > kMostSpectrumSamples || options.padding > 8) return kUndefined;
    const std::vector<double> amplitudes = spectrum(speeds, options.padding);
    const double step_hz = rate_hz / static_cast<double>(amplitudes.size());
    // The frequencies up to the cutoff whose amplitude reaches the threshold; all between the outermost count.
    std::size_t first = amplitudes.size(), last = 0;
    for (std::size_t i = 0; i < amplitudes.size() && static_cast<double>(i) * step_hz <= options.cutoff_hz; ++i) {
        if (!(amplitudes[i] >= options.threshold)) continue;
        first = std::min(first, i);
        last = i;
    }
    if (first >= last) return kUndefined;
    const double along = 1.0 / static_cast<double>(last - first);
    double length = 0.0;
    for (std::size_t i = first; i < last; ++i) length += std::hypot(along, amplitudes[i + 1] - amplitudes[i]);
    return -length;
}

double dimensionless_jerk(std::span<const double> speeds, double rate_hz) {
    if (!is_profile(speeds, rate_hz)) return kUndefined;
    double peak = 0.0, squares = 0.0;
    for (const double speed : speeds) peak = std::max(peak, std::abs(speed));
    for (std::size_t i = 2; i < speeds.size(); ++i) {
        const double jerk = (speeds[i] - 2.0 * speeds[i - 1] + speeds[i - 2]) * rate_hz * rate_hz;
        squares += jerk * jerk;
    }
    const double duration = static_cast<double>(speeds.size()) / rate_hz;
    return -duration * duration * duration / (peak * peak) * squares / rate_hz;
}

double log_dimensionless_jerk(std::span<const double> speeds, double rate_hz) {
    return -std::log(-dimensionless_jerk(speeds, rate_hz));
}

}  // namespace burin::study
