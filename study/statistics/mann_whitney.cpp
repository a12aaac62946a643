// SPDX-License-Identifier: MIT
#include "study/statistics/mann_whitney.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>

#include "study/statistics/distributions.hpp"
#include "study/statistics/ranks.hpp"

namespace burin::study {
namespace {

std::vector<double> pooled(std::span<const double> first, std::span<const double> second) {
    std::vector<double> all(first.begin(), first.end());
    all.insert(all.end(), second.begin(), second.end());
    return all;
}

std::string why_no_u(std::span<const double> first, std::span<const double> second) {
    if (first.empty() || second.empty()) return "a group is empty";
    return all_finite(first) && all_finite(second) ? "" : kNotFinite;
}

// U from the doubled sum of the first group's ranks.
double u_from(std::int64_t doubled_sum, std::size_t n) {
    const auto count = static_cast<double>(n);
    return 0.5 * static_cast<double>(doubled_sum) - 0.5 * count * (count + 1.0);
}

double u_of(std::span<const double> first, std::span<const double> second) {
    const std::vector<std::int64_t> ranks = doubled_midranks(pooled(first, second));
    const auto end = ranks.begin() + static_cast<std::ptrdiff_t>(first.size());
    return u_from(std::accumulate(ranks.begin(), end, std::int64_t{0}), first.size());
}

double exact_rank_sum_p(std::span<const double> first, std::span<const double> second) {
    const std::vector<std::int64_t> ranks = doubled_midranks(pooled(first, second));
    const std::span<const std::int64_t> all(ranks);
    // Either group's sum tells the other's; the smaller has the smaller table.
    const auto mine = first.size() <= second.size() ? all.first(first.size()) : all.subspan(first.size());
    const auto mean = static_cast<std::int64_t>(mine.size() * (ranks.size() + 1));
    const std::int64_t observed = std::abs(std::accumulate(mine.begin(), mine.end(), std::int64_t{0}) - mean);
    const std::vector<double> counts = rank_sum_counts(ranks, mine.size());
    double hits = 0.0, ways = 0.0;
    for (std::size_t s = 0; s < counts.size(); ++s) {
        ways += counts[s];
        if (std::abs(static_cast<std::int64_t>(s) - mean) >= observed) hits += counts[s];
    }
    return hits / ways;
}

}  // namespace

std::vector<double> rank_sum_counts(std::span<const std::int64_t> doubled_ranks, std::size_t chosen) {
    const auto largest =
        static_cast<std::size_t>(std::accumulate(doubled_ranks.begin(), doubled_ranks.end(), std::int64_t{0}));
    // counts[k][s]: ways to choose k of the ranks seen so far with sum s; each rank is taken once, hence from above.
    std::vector<std::vector<double>> counts(chosen + 1, std::vector<double>(largest + 1, 0.0));
    counts[0][0] = 1.0;
    std::size_t seen = 0, reached = 0;
    for (const std::int64_t doubled : doubled_ranks) {
        const auto rank = static_cast<std::size_t>(doubled);
        reached += rank;
        for (std::size_t k = std::min(chosen, ++seen); k >= 1; --k) {
            for (std::size_t s = reached; s >= rank; --s) counts[k][s] += counts[k - 1][s - rank];
        }
    }
    return counts[chosen];
}

NormalU normal_u(std::span<const double> first, std::span<const double> second) {
    NormalU normal;
    if (!why_no_u(first, second).empty()) return normal;
    const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size()), n = n1 + n2;
    normal.mean = 0.5 * n1 * n2;
    const double ties = n > 1.0 ? tie_term(pooled(first, second)) / (n * (n - 1.0)) : 0.0;
    normal.deviation = std::sqrt(std::max(0.0, n1 * n2 / 12.0 * (n + 1.0 - ties)));
    if (normal.deviation > 0.0) normal.z = (u_of(first, second) - normal.mean) / normal.deviation;
    return normal;
}

Outcome mann_whitney_normal(std::span<const double> first, std::span<const double> second) {
    Outcome outcome;
    outcome.method = "Mann-Whitney U test, normal approximation with tie and continuity correction";
    outcome.undefined = why_no_u(first, second);
    if (!outcome.undefined.empty()) return outcome;
    const NormalU normal = normal_u(first, second);
    outcome.statistic = u_of(first, second);
    const double distance = std::max(0.0, std::abs(outcome.statistic - normal.mean) - 0.5);
    outcome.p = normal.deviation > 0.0 ? normal_two_sided(distance / normal.deviation) : 1.0;
    return outcome;
}

Outcome mann_whitney(std::span<const double> first, std::span<const double> second) {
    if (first.size() + second.size() > kExactValues) return mann_whitney_normal(first, second);
    Outcome outcome;
    outcome.method = "Mann-Whitney U test, exact permutation p with midranks";
    outcome.undefined = why_no_u(first, second);
    if (!outcome.undefined.empty()) return outcome;
    outcome.statistic = u_of(first, second);
    outcome.p = exact_rank_sum_p(first, second);
    outcome.exact = true;
    return outcome;
}

}  // namespace burin::study
