// SPDX-License-Identifier: MIT
#include "study/statistics/effect_size.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "study/statistics/distributions.hpp"
#include "study/statistics/mann_whitney.hpp"

namespace burin::study {
namespace {

template <typename Number>
std::vector<Number> in_order(std::span<const Number> values) {
    std::vector<Number> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    return sorted;
}

std::string why_no_effect(std::span<const double> first, std::span<const double> second) {
    if (first.empty() || second.empty()) return "a group is empty";
    return all_finite(first) && all_finite(second) ? "" : kNotFinite;
}
std::string why_no_effect(std::span<const Int128> first, std::span<const Int128> second) {
    return first.empty() || second.empty() ? "a group is empty" : "";
}

// ---- Rank-biserial correlation

// The dominance of a value over the others is the number of those below it less the number of those above it. All sums
// are whole numbers, so that groups without overlap, and groups that are alike, are known for certain.
struct Dominances {
    Int128 sum = 0;      // over the values
    Int128 squares = 0;  // of the dominances
    Int128 tied = 0;     // pairs
};

template <typename Number>
Dominances dominances(std::span<const Number> values, const std::vector<Number>& others) {
    Dominances all;
    for (const Number& value : values) {
        const auto [begin, end] = std::ranges::equal_range(others, value);
        const Int128 dominance = (begin - others.begin()) - (others.end() - end);
        all.sum += dominance;
        all.squares += dominance * dominance;
        all.tied += end - begin;
    }
    return all;
}

// The unbiased estimate of the variance of delta, not below the least that is possible. With d_ij = 1, 0 or -1 of pair
// (i, j) and m the pairs: the sums of squared deviations of the rows' means, the columns' means and the pairs, over
// m (n1 - 1) (n2 - 1), all brought to the denominator m^2.
double variance_of_delta(const Dominances& rows, const Dominances& columns, Int128 n1, Int128 n2) {
    const Int128 pairs = n1 * n2, squared_sum = rows.sum * rows.sum;
    const Int128 of_means = n2 * (n1 * rows.squares - squared_sum) + n1 * (n2 * columns.squares - squared_sum);
    const Int128 of_pairs = pairs * (pairs - rows.tied) - squared_sum;
    const auto squared_pairs = static_cast<double>(pairs * pairs);
    const double unbiased =
        static_cast<double>(of_means - of_pairs) / squared_pairs / static_cast<double>((n1 - 1) * (n2 - 1));
    const double least = static_cast<double>(pairs * pairs - squared_sum) / squared_pairs /
                         static_cast<double>(std::max<Int128>(1, pairs - 1));
    return std::max(unbiased, least);
}

template <typename Number>
Estimate rank_biserial_of(std::span<const Number> first, std::span<const Number> second, double confidence) {
    Estimate estimate;
    estimate.method = "rank-biserial correlation (Cliff's delta), interval after Cliff and Feng, approximate";
    estimate.undefined = why_no_effect(first, second);
    if (!estimate.undefined.empty()) return estimate;
    const Dominances rows = dominances(first, in_order(second)), columns = dominances(second, in_order(first));
    const auto n1 = static_cast<Int128>(first.size()), n2 = static_cast<Int128>(second.size()), pairs = n1 * n2;
    const double d = estimate.value = static_cast<double>(rows.sum) / static_cast<double>(pairs);
    if (n1 < 2 || n2 < 2) {
        estimate.undefined = "no interval: a group has one value";
        return estimate;
    }
    estimate.confidence = confidence;
    const double z = normal_quantile(0.5 + 0.5 * confidence);
    if (rows.sum == pairs || rows.sum == -pairs) {
        const auto n = static_cast<double>(std::min(n1, n2));
        const double inner = (n - z * z) / (n + z * z);
        estimate.low = rows.sum > 0 ? inner : -1.0;
        estimate.high = rows.sum > 0 ? 1.0 : -inner;
        return estimate;
    }
    const double rest = static_cast<double>(pairs * pairs - rows.sum * rows.sum) / static_cast<double>(pairs * pairs);
    const double variance = variance_of_delta(rows, columns, n1, n2), zz = z * z * variance;
    const double middle = d * rest, bottom = rest + zz;
    const double reach = z * std::sqrt(variance) * std::sqrt(rest * rest + zz);
    estimate.low = std::max(-1.0, (middle - reach) / bottom);
    estimate.high = std::min(1.0, (middle + reach) / bottom);
    return estimate;
}

// ---- Hodges-Lehmann

class Differences {
public:
    Differences(std::span<const Int128> first, std::span<const Int128> second, const Step& step)
        : first_(in_order(first)), second_(in_order(second)), step_(step) {}

    [[nodiscard]] std::size_t count() const { return first_.size() * second_.size(); }

    // Returns the k-th least of all differences, k from 1.
    [[nodiscard]] double least(std::size_t k) const { return value_of(least_steps(k), step_); }

    [[nodiscard]] double median() const {
        const std::size_t half = count() / 2;
        return count() % 2 == 1 ? least(half + 1) : value_of(least_steps(half) + least_steps(half + 1), step_, 2);
    }

private:
    // By halves of the range.
    [[nodiscard]] Int128 least_steps(std::size_t k) const {
        Int128 low = first_.front() - second_.back(), high = first_.back() - second_.front();
        while (low < high) {
            const Int128 middle = low + (high - low) / 2;
            if (count_up_to(middle) >= k) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        return low;
    }

    [[nodiscard]] std::size_t count_up_to(Int128 bound) const {
        // As a grows, the b with a - b <= bound begin further up.
        std::size_t counted = 0, begin = 0;
        for (const Int128 a : first_) {
            while (begin < second_.size() && a - second_[begin] > bound) ++begin;
            counted += second_.size() - begin;
        }
        return counted;
    }

    std::vector<Int128> first_, second_;
    Step step_;
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
        if (sum / ways > tail * kAlikeProbabilities) break;
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

Estimate undefined_shift(const std::string& why) {
    Estimate estimate;
    estimate.method = "Hodges-Lehmann shift";
    estimate.undefined = why;
    return estimate;
}

}  // namespace

Estimate rank_biserial(std::span<const double> first, std::span<const double> second, double confidence) {
    return rank_biserial_of(first, second, confidence);
}
Estimate rank_biserial(std::span<const Int128> first, std::span<const Int128> second, double confidence) {
    return rank_biserial_of(first, second, confidence);
}

Estimate hodges_lehmann(std::span<const double> first, std::span<const double> second, double confidence) {
    if (const std::string why = why_no_effect(first, second); !why.empty()) return undefined_shift(why);
    const ExactGroups exact = exact_groups(first, second);
    return hodges_lehmann(exact.first, exact.second, exact.step, confidence);
}

Estimate hodges_lehmann(std::span<const Int128> first, std::span<const Int128> second, const Step& step,
                        double confidence) {
    Estimate estimate = undefined_shift(why_no_effect(first, second));
    if (!estimate.undefined.empty()) return estimate;
    const Differences differences(first, second, step);
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
