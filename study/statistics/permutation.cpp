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

// All values as their distance from the common mean, times the number of values: whole numbers. The first group's
// come first.
struct Dealt {
    std::vector<Int128> values;
    std::size_t n1 = 0;

    [[nodiscard]] Int128 first_sum() const {
        return std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n1), Int128{0});
    }
};

// Means differ by sum / n1 + sum / n2, where sum is the first group's.
bool as_far(Int128 sum, Int128 observed) { return std::max(sum, -sum) >= std::max(observed, -observed); }

Int128 sum_of(std::span<const Int128> steps) { return std::accumulate(steps.begin(), steps.end(), Int128{0}); }

Dealt deal(std::span<const Int128> first, std::span<const Int128> second) {
    Dealt dealt{.values = {first.begin(), first.end()}, .n1 = first.size()};
    dealt.values.insert(dealt.values.end(), second.begin(), second.end());
    const Int128 total = sum_of(dealt.values);
    for (Int128& value : dealt.values) value = value * static_cast<Int128>(dealt.values.size()) - total;
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
    const Int128 observed = dealt.first_sum();
    std::vector<std::size_t> chosen(dealt.n1);
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    const std::size_t n = dealt.values.size();
    double hits = 0.0, ways = 0.0;
    while (true) {
        Int128 sum = 0;
        for (const std::size_t i : chosen) sum += dealt.values[i];
        ways += 1.0;
        if (as_far(sum, observed)) hits += 1.0;
        std::size_t at = chosen.size();
        while (at > 0 && chosen[at - 1] == n - chosen.size() + at - 1) --at;
        if (at == 0) return hits / ways;
        ++chosen[at - 1];
        for (std::size_t i = at; i < chosen.size(); ++i) chosen[i] = chosen[i - 1] + 1;
    }
}

double sampled_share(Dealt dealt, std::uint64_t seed) {
    const Int128 observed = dealt.first_sum();
    Random random(seed);
    std::size_t hits = 0;
    for (std::size_t draw = 0; draw < kRandomDeals; ++draw) {
        for (std::size_t i = 0; i < dealt.n1; ++i)
            std::swap(dealt.values[i], dealt.values[i + random.below(dealt.values.size() - i)]);
        if (as_far(dealt.first_sum(), observed)) ++hits;
    }
    return static_cast<double>(1 + hits) / static_cast<double>(1 + kRandomDeals);
}

// The sum of n1 of n values drawn without replacement has the variance n1 n2 / n * s^2.
double normal_share(const Dealt& dealt) {
    const auto n1 = static_cast<double>(dealt.n1), n = static_cast<double>(dealt.values.size());
    double squares = 0.0;
    for (const Int128 value : dealt.values) squares += static_cast<double>(value) * static_cast<double>(value);
    const Int128 sum = dealt.first_sum();
    if (sum == 0) return 1.0;
    return normal_two_sided(static_cast<double>(sum) / std::sqrt(n1 * (n - n1) / n * squares / (n - 1.0)));
}

Outcome undefined_outcome(const std::string& why) {
    Outcome outcome;
    outcome.method = "permutation test of the difference of means";
    outcome.undefined = why;
    return outcome;
}

}  // namespace

Outcome permutation_of_means(std::span<const double> first, std::span<const double> second, std::uint64_t seed) {
    if (first.empty() || second.empty()) return undefined_outcome("a group is empty");
    if (!all_finite(first) || !all_finite(second)) return undefined_outcome(kNotFinite);
    const ExactGroups exact = exact_groups(first, second);
    return permutation_of_means(exact.first, exact.second, exact.step, seed);
}

Outcome permutation_of_means(std::span<const Int128> first, std::span<const Int128> second, const Step& step,
                             std::uint64_t seed) {
    Outcome outcome = undefined_outcome(first.empty() || second.empty() ? "a group is empty" : "");
    if (!outcome.undefined.empty()) return outcome;
    const auto n1 = static_cast<std::int64_t>(first.size()), n2 = static_cast<std::int64_t>(second.size());
    outcome.statistic = value_of(sum_of(first) * n2 - sum_of(second) * n1, step, n1 * n2);
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
