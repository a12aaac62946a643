// SPDX-License-Identifier: MIT
#include "study/statistics/mann_whitney.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "study/statistics/distributions.hpp"
#include "study/statistics/ranks.hpp"

namespace burin::study {
namespace {

// Doubled midranks of both groups together, the first group's first.
struct PooledRanks {
    std::vector<std::int64_t> doubled;
    std::size_t n1 = 0;

    [[nodiscard]] std::size_t n2() const { return doubled.size() - n1; }
    [[nodiscard]] std::span<const std::int64_t> first() const { return std::span(doubled).first(n1); }
    // Twice the distance of the first group's U from its middle, with its sign: a whole number.
    [[nodiscard]] std::int64_t doubled_distance() const {
        const std::int64_t sum = std::accumulate(first().begin(), first().end(), std::int64_t{0});
        return sum - static_cast<std::int64_t>(n1 * (doubled.size() + 1));
    }
    [[nodiscard]] double middle() const { return 0.5 * static_cast<double>(n1) * static_cast<double>(n2()); }
    [[nodiscard]] double u() const { return middle() + 0.5 * static_cast<double>(doubled_distance()); }
};

template <typename Number>
PooledRanks pooled_ranks(std::span<const Number> first, std::span<const Number> second) {
    std::vector<Number> all(first.begin(), first.end());
    all.insert(all.end(), second.begin(), second.end());
    return {.doubled = doubled_midranks(std::span<const Number>(all)), .n1 = first.size()};
}

// Why there is no U; empty where there is one.
std::string why_no_u(const PooledRanks& ranks) { return ranks.n1 == 0 || ranks.n2() == 0 ? "a group is empty" : ""; }

std::string why_no_u(std::span<const double> first, std::span<const double> second) {
    if (first.empty() || second.empty()) return "a group is empty";
    return all_finite(first) && all_finite(second) ? "" : kNotFinite;
}

double exact_rank_sum_p(const PooledRanks& ranks) {
    // Either group's sum tells the other's; the smaller has the smaller table.
    const std::size_t chosen = std::min(ranks.n1, ranks.n2());
    const auto mean = static_cast<std::int64_t>(chosen * (ranks.doubled.size() + 1));
    const std::int64_t observed = std::abs(ranks.doubled_distance());
    const std::vector<double> counts = rank_sum_counts(ranks.doubled, chosen);
    double hits = 0.0, ways = 0.0;
    for (std::size_t s = 0; s < counts.size(); ++s) {
        ways += counts[s];
        if (std::abs(static_cast<std::int64_t>(s) - mean) >= observed) hits += counts[s];
    }
    return hits / ways;
}

// The variance of U is n1 n2 (n^3 - n - ties) / (12 n (n - 1)), whose numerator is a whole number: 0 where all are
// equal, and never next to it.
NormalU normal_of(const PooledRanks& ranks) {
    NormalU normal;
    const auto n = static_cast<Int128>(ranks.doubled.size());
    const Int128 untied = n * n * n - n - tie_term(ranks.doubled);
    normal.mean = ranks.middle();
    const auto all = static_cast<double>(ranks.doubled.size());
    normal.deviation = std::sqrt(normal.mean * static_cast<double>(untied) / (6.0 * all * (all - 1.0)));
    if (untied > 0) normal.z = 0.5 * static_cast<double>(ranks.doubled_distance()) / normal.deviation;
    return normal;
}

Outcome normal_outcome(const PooledRanks& ranks, const std::string& undefined) {
    Outcome outcome;
    outcome.method = "Mann-Whitney U test, normal approximation with tie and continuity correction";
    outcome.undefined = undefined;
    if (!undefined.empty()) return outcome;
    const NormalU normal = normal_of(ranks);
    outcome.statistic = ranks.u();
    // 0.5 nearer to the middle, and not across it.
    const std::int64_t doubled_distance = std::max<std::int64_t>(0, std::abs(ranks.doubled_distance()) - 1);
    outcome.p = doubled_distance == 0 || std::isnan(normal.z)
                    ? 1.0
                    : normal_two_sided(0.5 * static_cast<double>(doubled_distance) / normal.deviation);
    return outcome;
}

Outcome exact_outcome(const PooledRanks& ranks, const std::string& undefined) {
    if (ranks.doubled.size() > kExactValues) return normal_outcome(ranks, undefined);
    Outcome outcome;
    outcome.method = "Mann-Whitney U test, exact permutation p with midranks";
    outcome.undefined = undefined;
    if (!undefined.empty()) return outcome;
    outcome.statistic = ranks.u();
    outcome.p = exact_rank_sum_p(ranks);
    outcome.exact = true;
    return outcome;
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
    return why_no_u(first, second).empty() ? normal_of(pooled_ranks(first, second)) : NormalU{};
}

Outcome mann_whitney_normal(std::span<const double> first, std::span<const double> second) {
    return normal_outcome(pooled_ranks(first, second), why_no_u(first, second));
}
Outcome mann_whitney_normal(std::span<const Int128> first, std::span<const Int128> second) {
    const PooledRanks ranks = pooled_ranks(first, second);
    return normal_outcome(ranks, why_no_u(ranks));
}

Outcome mann_whitney(std::span<const double> first, std::span<const double> second) {
    return exact_outcome(pooled_ranks(first, second), why_no_u(first, second));
}
Outcome mann_whitney(std::span<const Int128> first, std::span<const Int128> second) {
    const PooledRanks ranks = pooled_ranks(first, second);
    return exact_outcome(ranks, why_no_u(ranks));
}

}  // namespace burin::study
