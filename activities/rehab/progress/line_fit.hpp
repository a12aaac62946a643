// SPDX-License-Identifier: MIT
// The straight line of least squares through points, with the confidence interval of its slope: b +- t s / sqrt(Sxx),
// s the residuals' standard deviation with n - 2 degrees of freedom, t Student's quantile (Draper and Smith, "Applied
// regression analysis", 3rd edition, 1998, section 1.4). It holds where points scatter about the line independently,
// normally and evenly. Pure; any thread.
#pragma once

#include <optional>
#include <span>
#include <utility>

namespace burin::activities {

struct LineFit {
    static constexpr double kConfidence = 0.95;
    double slope = 0.0, lowest = 0.0, highest = 0.0;  // of the slope, in that interval
    unsigned freedom = 0;

    // Returns whether the interval leaves out a slope of zero.
    [[nodiscard]] bool is_beyond_scatter() const { return lowest > 0.0 || highest < 0.0; }
};
// Points (x, y). Returns nothing of fewer than three, or where all x are the same.
[[nodiscard]] std::optional<LineFit> line_through(std::span<const std::pair<double, double>> points);

}  // namespace burin::activities
