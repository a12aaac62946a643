// SPDX-License-Identifier: MIT
// Distribution functions and quantiles. Arguments outside the domain give NaN. Pure; any thread.
#pragma once

namespace burin::study {

// A probability that is at most this times a bound is at most the bound but for rounding: of 0.1 and 0.5 (1 - 0.8) both
// are one tenth. Probabilities of counted ways differ by far more.
inline constexpr double kAlikeProbabilities = 1.0 + 1e-12;

// P(|Z| >= |z|) of a standard normal Z.
[[nodiscard]] double normal_two_sided(double z);
// The z with P(Z <= z) = p, 0 < p < 1.
[[nodiscard]] double normal_quantile(double p);

// The regularised incomplete beta function I_x(a, b) by the continued fraction of DLMF 8.17.22, a and b above 0.
[[nodiscard]] double incomplete_beta(double a, double b, double x);

// P(|T| >= |t|) of Student's t with that many degrees of freedom.
[[nodiscard]] double student_two_sided(double t, double freedom);

// P(F <= x) of Fisher's F, and the x with P(F <= x) = p.
[[nodiscard]] double f_distribution(double x, double freedom1, double freedom2);
[[nodiscard]] double f_quantile(double p, double freedom1, double freedom2);

}  // namespace burin::study
