// SPDX-License-Identifier: MIT
// Order statistics and sums of measured values. All are 0 where there are no values. Any thread; those that take their
// values by copy reorder them. Not for the haptic thread: it counts in haptics/histogram.hpp, without heap.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace burin {

// Returns the value below which the given share of the values lies, by nearest rank: always one of the values.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
    std::ranges::nth_element(values, at);
    return *at;
}

[[nodiscard]] inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

// Returns the median as statistics books have it: of an even number of values the mean of the two in the middle.
[[nodiscard]] inline double middle_value(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

[[nodiscard]] inline double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

[[nodiscard]] inline double mean(const std::vector<double>& values) {
    return values.empty() ? 0.0 : sum(values) / static_cast<double>(values.size());
}

[[nodiscard]] inline double least(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::ranges::min_element(values);
}

[[nodiscard]] inline double most(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

}  // namespace burin
