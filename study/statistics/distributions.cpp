// SPDX-License-Identifier: MIT
#include "study/statistics/distributions.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace burin::study {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// The x in (low, high) at which the rising function f reaches 0; halves until neighbouring doubles are left.
template <typename F>
double root_of_rising(double low, double high, F&& f) {
    for (int i = 0; i < 2000; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (f(middle) < 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// The continued fraction of I_x(a, b), by the method of Lentz (Applied Optics 15(3), 1976). Converges for
// x < (a + 1) / (a + b + 2), in about sqrt(max(a, b)) steps.
double beta_fraction(double a, double b, double x) {
    constexpr double kTiny = 1e-300;
    const auto away_from_zero = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
    double c = 1.0, d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0)), fraction = d;
    for (int m = 1; m <= 100'000; ++m) {
        const double k = m;
        const double even = k * (b - k) * x / ((a + 2.0 * k - 1.0) * (a + 2.0 * k));
        d = 1.0 / away_from_zero(1.0 + even * d);
        c = away_from_zero(1.0 + even / c);
        fraction *= d * c;
        const double odd = -(a + k) * (a + b + k) * x / ((a + 2.0 * k) * (a + 2.0 * k + 1.0));
        d = 1.0 / away_from_zero(1.0 + odd * d);
        c = away_from_zero(1.0 + odd / c);
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < 1e-16) break;
    }
    return fraction;
}

}  // namespace

double normal_two_sided(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double normal_quantile(double p) {
    if (!(p > 0.0 && p < 1.0)) return kNoNumber;
    // By the lower tail, where erfc keeps all digits of a small p.
    if (p > 0.5) return -normal_quantile(1.0 - p);
    return root_of_rising(-40.0, 0.0, [&](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2) - p; });
}

double incomplete_beta(double a, double b, double x) {
    if (!(a > 0.0 && b > 0.0 && x >= 0.0 && x <= 1.0)) return kNoNumber;
    if (x == 0.0 || x == 1.0) return x;
    const double log_front =
        std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
    if (x < (a + 1.0) / (a + b + 2.0)) return std::exp(log_front) * beta_fraction(a, b, x) / a;
    return 1.0 - std::exp(log_front) * beta_fraction(b, a, 1.0 - x) / b;
}

double student_two_sided(double t, double freedom) {
    if (!(freedom > 0.0) || std::isnan(t)) return kNoNumber;
    return std::isinf(t) ? 0.0 : incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

double f_distribution(double x, double freedom1, double freedom2) {
    if (!(freedom1 > 0.0 && freedom2 > 0.0) || std::isnan(x)) return kNoNumber;
    if (x <= 0.0) return 0.0;
    if (std::isinf(x)) return 1.0;
    return incomplete_beta(0.5 * freedom1, 0.5 * freedom2, freedom1 * x / (freedom1 * x + freedom2));
}

double f_quantile(double p, double freedom1, double freedom2) {
    if (!(p > 0.0 && p < 1.0 && freedom1 > 0.0 && freedom2 > 0.0)) return kNoNumber;
    // x = y / (1 - y) maps the half line to (0, 1).
    const double y =
        root_of_rising(0.0, 1.0, [&](double at) { return f_distribution(at / (1.0 - at), freedom1, freedom2) - p; });
    return y / (1.0 - y);
}

}  // namespace burin::study
