// SPDX-License-Identifier: MIT
#include "study/statistics/ranks.hpp"

#include <algorithm>
#include <numeric>

namespace burin::study {
namespace {

std::vector<double> halved(const std::vector<std::int64_t>& doubled_ranks) {
    std::vector<double> ranks;
    ranks.reserve(doubled_ranks.size());
    for (const std::int64_t doubled : doubled_ranks) ranks.push_back(0.5 * static_cast<double>(doubled));
    return ranks;
}

template <typename Number>
std::vector<std::int64_t> doubled_ranks_of(std::span<const Number> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<std::int64_t> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        // The mean of the ranks first + 1 .. end, twice.
        for (std::size_t i = first; i < end; ++i) ranks[order[i]] = static_cast<std::int64_t>(first + 1 + end);
        first = end;
    }
    return ranks;
}

}  // namespace

std::vector<std::int64_t> doubled_midranks(std::span<const double> values) { return doubled_ranks_of(values); }
std::vector<std::int64_t> doubled_midranks(std::span<const Int128> values) { return doubled_ranks_of(values); }

std::vector<double> midranks(std::span<const double> values) { return halved(doubled_midranks(values)); }
std::vector<double> midranks(std::span<const Int128> values) { return halved(doubled_midranks(values)); }

Int128 tie_term(std::span<const std::int64_t> doubled_ranks) {
    std::vector<std::int64_t> sorted(doubled_ranks.begin(), doubled_ranks.end());
    std::ranges::sort(sorted);
    Int128 term = 0;
    for (auto first = sorted.begin(); first != sorted.end();) {
        const auto end = std::upper_bound(first, sorted.end(), *first);
        const Int128 tied = end - first;
        term += tied * tied * tied - tied;
        first = end;
    }
    return term;
}

}  // namespace burin::study
