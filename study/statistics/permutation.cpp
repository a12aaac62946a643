// SPDX-License-Identifier: MIT
#include "study/statistics/permutation.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/statistics.hpp"
#include "base/text.hpp"
#include "study/statistics/distributions.hpp"
#include "study/statistics/random.hpp"

namespace burin::study {
namespace {

// All values as deviations from their common mean, the first group's first.
struct Dealt {
    std::vector<double> values;
    std::size_t n1 = 0;
    double tolerance = 0.0;  // of a sum

    // Means differ by sum / n1 + sum / n2, where sum is the first group's.
    [[nodiscard]] bool as_far(double sum, double observed) const {
        return std::abs(sum) >= std::abs(observed) - tolerance;
    }
    [[nodiscard]] double first_sum() const {
        return std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n1), 0.0);
    }
};

Dealt deal(std::span<const double> first, std::span<const double> second) {
    Dealt dealt{.values = {first.begin(), first.end()}, .n1 = first.size()};
    dealt.values.insert(dealt.values.end(), second.begin(), second.end());
    const double middle = mean(dealt.values);
    double largest = 0.0;
    for (double& value : dealt.values) {
        largest = std::max(largest, std::abs(value));
        value -= middle;
    }
    dealt.tolerance = 1e-12 * largest * static_cast<double>(dealt.values.size());
    return dealt;
}

double ways_to_choose(std::size_t n, std::size_t k) {
    double ways = 1.0;
    for (std::size_t i = 1; i <= std::min(k, n - k); ++i)
        ways = ways * static_cast<double>(n + 1 - i) / static_cast<double>(i);
    return ways;
}

// Visits every choice of n1 of the values, as rising places.
double exact_share(const Dealt& dealt) {
    const double observed = dealt.first_sum();
    std::vector<std::size_t> chosen(dealt.n1);
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    const std::size_t n = dealt.values.size();
    double hits = 0.0, ways = 0.0;
    while (true) {
        double sum = 0.0;
        for (const std::size_t i : chosen) sum += dealt.values[i];
        ways += 1.0;
        if (dealt.as_far(sum, observed)) hits += 1.0;
        std::size_t at = chosen.size();
        while (at > 0 && chosen[at - 1] == n - chosen.size() + at - 1) --at;
        if (at == 0) return hits / ways;
        ++chosen[at - 1];
        for (std::size_t i = at; i < chosen.size(); ++i) chosen[i] = chosen[i - 1] + 1;
    }
}

double sampled_share(Dealt dealt, std::uint64_t seed) {
    const double observed = dealt.first_sum();
    Random random(seed);
    std::size_t hits = 0;
    for (std::size_t draw = 0; draw < kRandomDeals; ++draw) {
        for (std::size_t i = 0; i < dealt.n1; ++i)
            std::swap(dealt.values[i], dealt.values[i + random.below(dealt.values.size() - i)]);
        if (dealt.as_far(dealt.first_sum(), observed)) ++hits;
    }
    return static_cast<double>(1 + hits) / static_cast<double>(1 + kRandomDeals);
}

// The sum of n1 of n values drawn without replacement has the variance n1 n2 / n * s^2.
double normal_share(const Dealt& dealt) {
    const auto n1 = static_cast<double>(dealt.n1), n = static_cast<double>(dealt.values.size());
    const double squares = std::inner_product(dealt.values.begin(), dealt.values.end(), dealt.values.begin(), 0.0);
    const double deviation = std::sqrt(n1 * (n - n1) / n * squares / (n - 1.0));
    return deviation > 0.0 ? normal_two_sided(dealt.first_sum() / deviation) : 1.0;
}

}  // namespace

Outcome permutation_of_means(std::span<const double> first, std::span<const double> second, std::uint64_t seed) {
    Outcome outcome;
    outcome.method = "permutation test of the difference of means";
    if (first.empty() || second.empty()) outcome.undefined = "a group is empty";
    if (!all_finite(first) || !all_finite(second)) outcome.undefined = kNotFinite;
    if (!outcome.undefined.empty()) return outcome;
    outcome.statistic = mean({first.begin(), first.end()}) - mean({second.begin(), second.end()});
    const Dealt dealt = deal(first, second);
    if (ways_to_choose(dealt.values.size(), dealt.n1) <= kMostDeals) {
        outcome.exact = true;
        outcome.p = exact_share(dealt);
        outcome.method += ", exact p";
    } else if (dealt.values.size() <= kMostDealt) {
        outcome.p = sampled_share(dealt, seed);
        outcome.method +=
            formatted(", p from %zu random deals, seed %llu", kRandomDeals, static_cast<unsigned long long>(seed));
    } else {
        outcome.p = normal_share(dealt);
        outcome.method += ", p from the normal approximation";
    }
    return outcome;
}

}  // namespace burin::study
