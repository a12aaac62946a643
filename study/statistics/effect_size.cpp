// SPDX-License-Identifier: MIT
#include "study/statistics/effect_size.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <vector>

#include "study/statistics/distributions.hpp"
#include "study/statistics/mann_whitney.hpp"

namespace burin::study {
namespace {

std::vector<double> in_order(std::span<const double> values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return sorted;
}

std::string why_no_effect(std::span<const double> first, std::span<const double> second) {
    if (first.empty() || second.empty()) return "a group is empty";
    return all_finite(first) && all_finite(second) ? "" : kNotFinite;
}

// ---- Rank-biserial correlation

// The share of the others (sorted) that a value exceeds, less the share that exceeds it; and the share equal to it.
struct Dominance {
    double mean = 0.0, tied = 0.0;
};

Dominance dominance_over(double value, const std::vector<double>& others) {
    const auto n = static_cast<double>(others.size());
    const auto [begin, end] = std::ranges::equal_range(others, value);
    const auto below = static_cast<double>(begin - others.begin()), above = static_cast<double>(others.end() - end);
    return {.mean = (below - above) / n, .tied = static_cast<double>(end - begin) / n};
}

// The mean dominance of the values over the others, the sum of its squared deviations, and the share of tied pairs.
struct Dominances {
    double mean = 0.0, squares = 0.0, tied = 0.0;
};

Dominances dominances(std::span<const double> values, const std::vector<double>& others) {
    Dominances all;
    const auto n = static_cast<double>(values.size());
    std::vector<double> means;
    for (const double value : values) {
        const Dominance one = dominance_over(value, others);
        means.push_back(one.mean);
        all.mean += one.mean / n;
        all.tied += one.tied / n;
    }
    for (const double mean : means) all.squares += (mean - all.mean) * (mean - all.mean);
    return all;
}

// The unbiased estimate of the variance of delta, not below the least that is possible.
double variance_of_delta(const Dominances& rows, const Dominances& columns, double n1, double n2) {
    const double d = rows.mean, pairs = n1 * n2;
    // The sum of (d_ij - d)^2 over all pairs, where d_ij is 1, 0 or -1.
    const double of_pairs = pairs * (1.0 - rows.tied) - pairs * d * d;
    const double unbiased =
        (n2 * n2 * rows.squares + n1 * n1 * columns.squares - of_pairs) / (pairs * (n1 - 1.0) * (n2 - 1.0));
    return std::max(unbiased, (1.0 - d * d) / (pairs - 1.0));
}

// ---- Hodges-Lehmann

// Doubles in their order as whole numbers, so that a search by halves visits every double there is.
std::int64_t place_of(double value) {
    const auto bits = std::bit_cast<std::int64_t>(value);
    return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}
double double_at(std::int64_t place) {
    return std::bit_cast<double>(place < 0 ? std::numeric_limits<std::int64_t>::min() - place : place);
}

class Differences {
public:
    Differences(std::span<const double> first, std::span<const double> second)
        : first_(in_order(first)), second_(in_order(second)) {}

    // Returns the k-th least of all differences, k from 1. Rounding keeps order, so that one walk counts those up to a
    // bound.
    [[nodiscard]] double least(std::size_t k) const {
        std::int64_t low = place_of(first_.front() - second_.back()), high = place_of(first_.back() - second_.front());
        while (low < high) {
            const std::int64_t middle =
                low +
                static_cast<std::int64_t>((static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low)) / 2);
            if (count_up_to(double_at(middle)) >= k) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        return double_at(low);
    }

    [[nodiscard]] std::size_t count() const { return first_.size() * second_.size(); }

    [[nodiscard]] double median() const {
        const std::size_t half = count() / 2;
        return count() % 2 == 1 ? least(half + 1) : 0.5 * (least(half) + least(half + 1));
    }

private:
    [[nodiscard]] std::size_t count_up_to(double bound) const {
        // As a grows, the b with a - b <= bound begin further up.
        std::size_t counted = 0, begin = 0;
        for (const double a : first_) {
            while (begin < second_.size() && a - second_[begin] > bound) ++begin;
            counted += second_.size() - begin;
        }
        return counted;
    }

    std::vector<double> first_, second_;
};

// The largest k, at least 1, with P(U <= k - 1) <= tail where nothing is tied, and that probability.
struct OuterDifference {
    std::size_t k = 1;
    double tail = 0.0;
};

OuterDifference exact_k(std::size_t n1, std::size_t n2, double tail) {
    std::vector<std::int64_t> ranks(n1 + n2);
    std::iota(ranks.begin(), ranks.end(), std::int64_t{1});  // undoubled: nothing is tied
    const std::size_t chosen = std::min(n1, n2), least_sum = chosen * (chosen + 1) / 2;
    const std::vector<double> counts = rank_sum_counts(ranks, chosen);
    const double ways = std::accumulate(counts.begin(), counts.end(), 0.0);
    OuterDifference found{.k = 1, .tail = counts[least_sum] / ways};
    for (double sum = counts[least_sum]; found.k < n1 * n2; ++found.k) {
        sum += counts[least_sum + found.k];
        if (sum / ways > tail) break;
        found.tail = sum / ways;
    }
    return found;
}

OuterDifference normal_k(std::size_t n1, std::size_t n2, double tail) {
    const auto a = static_cast<double>(n1), b = static_cast<double>(n2);
    const double deviation = std::sqrt(a * b * (a + b + 1.0) / 12.0);
    const double k = std::floor(0.5 * a * b + normal_quantile(tail) * deviation + 0.5);
    return {.k = static_cast<std::size_t>(std::max(1.0, k)), .tail = tail};
}

}  // namespace

Estimate rank_biserial(std::span<const double> first, std::span<const double> second, double confidence) {
    Estimate estimate;
    estimate.method = "rank-biserial correlation (Cliff's delta), interval after Cliff and Feng, approximate";
    estimate.undefined = why_no_effect(first, second);
    if (!estimate.undefined.empty()) return estimate;
    const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
    const Dominances rows = dominances(first, in_order(second)), columns = dominances(second, in_order(first));
    const double d = estimate.value = rows.mean, z = normal_quantile(0.5 + 0.5 * confidence);
    if (n1 < 2.0 || n2 < 2.0) {
        estimate.undefined = "no interval: a group has one value";
        return estimate;
    }
    estimate.confidence = confidence;
    if (std::abs(d) >= 1.0) {
        const double n = std::min(n1, n2), inner = (n - z * z) / (n + z * z);
        estimate.low = d > 0.0 ? inner : -1.0;
        estimate.high = d > 0.0 ? 1.0 : -inner;
        return estimate;
    }
    const double variance = variance_of_delta(rows, columns, n1, n2), zz = z * z * variance;
    const double middle = d - d * d * d, bottom = 1.0 - d * d + zz;
    const double reach = z * std::sqrt(variance) * std::sqrt((1.0 - d * d) * (1.0 - d * d) + zz);
    estimate.low = std::max(-1.0, (middle - reach) / bottom);
    estimate.high = std::min(1.0, (middle + reach) / bottom);
    return estimate;
}

Estimate hodges_lehmann(std::span<const double> first, std::span<const double> second, double confidence) {
    Estimate estimate;
    estimate.method = "Hodges-Lehmann shift";
    estimate.undefined = why_no_effect(first, second);
    if (!estimate.undefined.empty()) return estimate;
    const Differences differences(first, second);
    const double tail = 0.5 * (1.0 - confidence);
    estimate.exact = first.size() + second.size() <= kExactValues;
    const OuterDifference outer =
        estimate.exact ? exact_k(first.size(), second.size(), tail) : normal_k(first.size(), second.size(), tail);
    estimate.method += estimate.exact ? ", interval from the exact distribution of U"
                                      : ", interval from the normal approximation of U";
    estimate.value = differences.median();
    estimate.low = differences.least(outer.k);
    estimate.high = differences.least(differences.count() + 1 - outer.k);
    estimate.confidence = std::max(0.0, 1.0 - 2.0 * outer.tail);
    return estimate;
}

}  // namespace burin::study
