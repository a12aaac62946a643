// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/line_fit.hpp"

#include <algorithm>
#include <cmath>

#include "study/statistics/distributions.hpp"

namespace burin::activities {

std::optional<LineFit> line_through(std::span<const std::pair<double, double>> points) {
    if (points.size() < 3) return std::nullopt;
    const auto count = static_cast<double>(points.size());
    double x_mean = 0.0, y_mean = 0.0;
    for (const auto& [x, y] : points) {
        x_mean += x / count;
        y_mean += y / count;
    }
    double sxx = 0.0, sxy = 0.0;
    for (const auto& [x, y] : points) {
        sxx += (x - x_mean) * (x - x_mean);
        sxy += (x - x_mean) * (y - y_mean);
    }
    if (!(sxx > 0.0)) return std::nullopt;
    LineFit fit;
    fit.slope = sxy / sxx;
    fit.freedom = static_cast<unsigned>(points.size() - 2);
    double residuals = 0.0;
    for (const auto& [x, y] : points) {
        const double off = y - y_mean - fit.slope * (x - x_mean);
        residuals += off * off;
    }
    // The two-sided quantile of t: its square is distributed as F with 1 degree of freedom.
    const double t = std::sqrt(study::f_quantile(LineFit::kConfidence, 1.0, fit.freedom));
    const double half = t * std::sqrt(residuals / fit.freedom / sxx);
    fit.lowest = fit.slope - half;
    fit.highest = fit.slope + half;
    return fit;
}

}  // namespace burin::activities
