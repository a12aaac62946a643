// SPDX-License-Identifier: MIT
#include "study/statistics/spearman.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "study/statistics/distributions.hpp"
#include "study/statistics/random.hpp"
#include "study/statistics/ranks.hpp"

namespace burin::study {
namespace {

using Ranks = std::vector<std::int64_t>;  // doubled

std::int64_t product_of(const Ranks& a, const Ranks& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), std::int64_t{0});
}

// How far a sum of products is from its mean over all pairings, times n: a whole number.
class Distance {
public:
    explicit Distance(std::size_t n) : n_(static_cast<std::int64_t>(n)) {
        const std::int64_t sum = n_ * (n_ + 1);  // of the doubled ranks, ties or not
        mean_times_n_ = sum * sum;
    }
    [[nodiscard]] std::int64_t of(std::int64_t product) const { return std::abs(n_ * product - mean_times_n_); }

private:
    std::int64_t n_, mean_times_n_ = 0;
};

// Counts, for every value of the sum of products, the pairings that give it. By subsets: the first k of x are paired
// with the members of a subset of k of y, in any order, and the counts of a subset follow from those with one less.
std::vector<std::uint64_t> product_counts(const Ranks& x, const Ranks& y) {
    const std::size_t n = x.size();
    std::vector<std::vector<std::uint64_t>> of_subset(std::size_t{1} << n);
    of_subset[0] = {1};
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t subset = 0; subset < of_subset.size(); ++subset) {
            if (static_cast<std::size_t>(std::popcount(subset)) != k) continue;
            const std::vector<std::uint64_t> counts = std::exchange(of_subset[subset], {});
            for (std::size_t i = 0; i < n; ++i) {
                if ((subset >> i & 1u) != 0) continue;
                const auto product = static_cast<std::size_t>(x[k] * y[i]);
                std::vector<std::uint64_t>& more = of_subset[subset | std::size_t{1} << i];
                more.resize(std::max(more.size(), counts.size() + product));
                for (std::size_t s = 0; s < counts.size(); ++s) more[s + product] += counts[s];
            }
        }
    }
    return of_subset.back();
}

double exact_p(const Ranks& x, const Ranks& y) {
    const Distance distance(x.size());
    const std::int64_t observed = distance.of(product_of(x, y));
    double hits = 0.0, all = 0.0;
    const std::vector<std::uint64_t> counts = product_counts(x, y);
    for (std::size_t s = 0; s < counts.size(); ++s) {
        const auto count = static_cast<double>(counts[s]);
        all += count;
        if (distance.of(static_cast<std::int64_t>(s)) >= observed) hits += count;
    }
    return hits / all;
}

double sampled_p(const Ranks& x, Ranks y, std::uint64_t seed) {
    const Distance distance(x.size());
    const std::int64_t observed = distance.of(product_of(x, y));
    Random random(seed);
    std::size_t hits = 0;
    for (std::size_t draw = 0; draw < kPairings; ++draw) {
        for (std::size_t i = y.size(); i > 1; --i) std::swap(y[i - 1], y[random.below(i)]);
        if (distance.of(product_of(x, y)) >= observed) ++hits;
    }
    return static_cast<double>(1 + hits) / static_cast<double>(1 + kPairings);
}

bool all_equal(const Ranks& ranks) { return std::ranges::adjacent_find(ranks, std::not_equal_to{}) == ranks.end(); }

// Sums are whole numbers, so that the correlation is rounded once where neither list has ties, and is exactly 1 where
// both rise together.
double correlation_of(const Ranks& x, const Ranks& y) {
    const auto mean = static_cast<std::int64_t>(x.size() + 1);
    Int128 xy = 0, xx = 0, yy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Int128 dx = x[i] - mean, dy = y[i] - mean;
        xy += dx * dy;
        xx += dx * dx;
        yy += dy * dy;
    }
    if (xx == yy) return static_cast<double>(xy) / static_cast<double>(xx);
    const auto of_both = std::sqrt(static_cast<long double>(xx) * static_cast<long double>(yy));
    return static_cast<double>(static_cast<long double>(xy) / of_both);
}

Outcome undefined_correlation(const std::string& why) {
    Outcome outcome;
    outcome.method = "Spearman's rank correlation of midranks";
    outcome.undefined = why;
    return outcome;
}

Outcome correlation_outcome(const Ranks& rx, const Ranks& ry, std::uint64_t seed) {
    const std::size_t n = rx.size();
    if (n < 2) return undefined_correlation("fewer than two pairs");
    if (all_equal(rx) || all_equal(ry)) return undefined_correlation("all values of one variable are equal");
    Outcome outcome = undefined_correlation("");
    outcome.statistic = correlation_of(rx, ry);
    if (n <= kExactPairs) {
        outcome.p = exact_p(rx, ry);
        outcome.exact = true;
        outcome.method += ", exact permutation p";
    } else if (n <= kSampledPairs) {
        outcome.p = sampled_p(rx, ry, seed);
        outcome.method +=
            formatted(", p from %zu random permutations, seed %llu", kPairings, static_cast<unsigned long long>(seed));
    } else {
        const double r = outcome.statistic, freedom = static_cast<double>(n) - 2.0;
        outcome.p = student_two_sided(r * std::sqrt(freedom / std::max(0.0, (1.0 - r) * (1.0 + r))), freedom);
        outcome.method += ", p from Student's t";
    }
    return outcome;
}

}  // namespace

Outcome spearman(std::span<const double> x, std::span<const double> y, std::uint64_t seed) {
    BURIN_CHECK(x.size() == y.size());
    const std::size_t n = std::min(x.size(), y.size());
    if (n >= 2 && (!all_finite(x.first(n)) || !all_finite(y.first(n)))) return undefined_correlation(kNotFinite);
    return correlation_outcome(doubled_midranks(x.first(n)), doubled_midranks(y.first(n)), seed);
}

Outcome spearman(std::span<const Int128> x, std::span<const Int128> y, std::uint64_t seed) {
    BURIN_CHECK(x.size() == y.size());
    const std::size_t n = std::min(x.size(), y.size());
    return correlation_outcome(doubled_midranks(x.first(n)), doubled_midranks(y.first(n)), seed);
}

}  // namespace burin::study
