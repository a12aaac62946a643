// SPDX-License-Identifier: MIT
// Smoothness of a movement from its speed profile, sampled at equal intervals. All are dimensionless, below 0, and
// nearer to 0 the smoother the movement. NaN where they are not defined: fewer than three samples, a value that is not
// finite, a rate that is not above 0, no movement. Pure; any thread; allocates.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin::study {

// Returns the speeds between neighbouring positions, one fewer than these.
[[nodiscard]] std::vector<double> speeds_m_per_s(std::span<const Vec3> positions_m, double rate_hz);

// The spectral arc length (Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet, "On the analysis of movement
// smoothness", 2015): minus the length of the curve of the normalised amplitude spectrum, from the first to the last
// frequency up to cutoff_hz that reaches `threshold` of the largest amplitude. The spectrum is that of the profile
// padded with zeroes to 2^(ceil(log2 n) + padding) samples. Above kMostSpectrumSamples samples: NaN. Cost: an FFT of
// the padded length, 32 bytes a sample of it.
struct SpectrumOptions {
    double cutoff_hz = 10.0, threshold = 0.05;
    unsigned padding = 4;  // at most 8
};
inline constexpr std::size_t kMostSpectrumSamples = std::size_t{1} << 20;  // 17 minutes at 1 kHz
[[nodiscard]] double spectral_arc_length(std::span<const double> speeds, double rate_hz,
                                         const SpectrumOptions& options = {});

// The dimensionless jerk (Hogan and Sternad, "Sensitivity of smoothness measures to movement duration, amplitude, and
// arrests", 2009, with the peak speed): -T^3 / v_peak^2 times the integral of the squared second derivative of speed
// over the duration T = n / rate. -204.8 for the movement of least jerk.
[[nodiscard]] double dimensionless_jerk(std::span<const double> speeds, double rate_hz);
// Its logarithm: -log(-dimensionless_jerk).
[[nodiscard]] double log_dimensionless_jerk(std::span<const double> speeds, double rate_hz);

}  // namespace burin::study
