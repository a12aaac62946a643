// SPDX-License-Identifier: MIT
#include "study/statistics/ranks.hpp"

#include <algorithm>
#include <numeric>

namespace burin::study {
namespace {

// Calls f(first, end, order) for every run of equal values, by places in `order`, which sorts the values.
template <typename F>
void for_each_tie(std::span<const double> values, F&& f) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        f(first, end, order);
        first = end;
    }
}

}  // namespace

std::vector<std::int64_t> doubled_midranks(std::span<const double> values) {
    std::vector<std::int64_t> ranks(values.size());
    for_each_tie(values, [&](std::size_t first, std::size_t end, const std::vector<std::size_t>& order) {
        // The mean of the ranks first + 1 .. end, twice.
        for (std::size_t i = first; i < end; ++i) ranks[order[i]] = static_cast<std::int64_t>(first + 1 + end);
    });
    return ranks;
}

std::vector<double> midranks(std::span<const double> values) {
    std::vector<double> ranks;
    ranks.reserve(values.size());
    for (const std::int64_t doubled : doubled_midranks(values)) ranks.push_back(0.5 * static_cast<double>(doubled));
    return ranks;
}

double tie_term(std::span<const double> values) {
    double term = 0.0;
    for_each_tie(values, [&](std::size_t first, std::size_t end, const std::vector<std::size_t>&) {
        const auto tied = static_cast<double>(end - first);
        term += tied * tied * tied - tied;
    });
    return term;
}

}  // namespace burin::study
