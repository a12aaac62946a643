// SPDX-License-Identifier: MIT
// Statistics on random values with many ties, against the slow way that their definitions spell out.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

#include "study/statistics/effect_size.hpp"
#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/permutation.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/spearman.hpp"

namespace burin::study {
namespace {

using Values = std::vector<double>;

// From `least` to `most` whole numbers between 0 and 5, so that most lists have ties; halved, so that sums are exact.
Values tied_values(std::size_t least, std::size_t most) {
    const auto count = *rc::gen::inRange(least, most + 1);
    Values values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(0.5 * *rc::gen::inRange(0, 6));
    return values;
}

double twice_u(const Values& first, const Values& second) {
    double twice = 0.0;
    for (const double a : first) {
        for (const double b : second) twice += a > b ? 2.0 : a == b ? 1.0 : 0.0;
    }
    return twice;
}

// Calls f(first, second) for every way to deal the values of both groups out to groups of the same sizes.
template <typename F>
void for_each_deal(const Values& first, const Values& second, F&& f) {
    Values all = first;
    all.insert(all.end(), second.begin(), second.end());
    for (unsigned chosen = 0; chosen < 1u << all.size(); ++chosen) {
        if (static_cast<std::size_t>(std::popcount(chosen)) != first.size()) continue;
        Values a, b;
        for (std::size_t i = 0; i < all.size(); ++i) (chosen >> i & 1u ? a : b).push_back(all[i]);
        f(a, b);
    }
}

TEST(Ranks, AreOnePlusThoseBelowAndHalfOfTheOtherEquals) {
    EXPECT_TRUE(rc::check([] {
        const Values values = tied_values(0, 30);
        const Values ranks = midranks(values);
        RC_ASSERT(ranks.size() == values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto below = std::ranges::count_if(values, [&](double v) { return v < values[i]; });
            const auto equal = std::ranges::count(values, values[i]);
            RC_ASSERT(ranks[i] == static_cast<double>(below) + 0.5 * (static_cast<double>(equal) + 1.0));
        }
    }));
}

TEST(MannWhitney, CountsTheSamePairsAndDealsAsEnumeration) {
    EXPECT_TRUE(rc::check([] {
        const Values first = tied_values(1, 6), second = tied_values(1, 5);
        const double pairs = static_cast<double>(first.size() * second.size());
        const double observed = std::abs(twice_u(first, second) - pairs);
        double hits = 0.0, deals = 0.0;
        for_each_deal(first, second, [&](const Values& a, const Values& b) {
            deals += 1.0;
            hits += std::abs(twice_u(a, b) - pairs) >= observed ? 1.0 : 0.0;
        });
        const Outcome outcome = mann_whitney(first, second);
        RC_ASSERT(outcome.exact);
        RC_ASSERT(outcome.statistic == 0.5 * twice_u(first, second));
        RC_ASSERT(std::abs(outcome.p - hits / deals) < 1e-14);  // both count whole deals
    }));
}

TEST(MannWhitney, GivesTheSameProbabilityWhicheverGroupComesFirst) {
    EXPECT_TRUE(rc::check([] {
        const Values first = tied_values(1, 20), second = tied_values(1, 20);
        const Outcome one = mann_whitney(first, second), other = mann_whitney(second, first);
        RC_ASSERT(one.statistic + other.statistic == static_cast<double>(first.size() * second.size()));
        RC_ASSERT(std::abs(one.p - other.p) < 1e-12);  // sums of counts below 2^53 in another order
        RC_ASSERT(mann_whitney_normal(first, second).p == mann_whitney_normal(second, first).p);
    }));
}

TEST(PermutationOfMeans, CountsTheSameDealsAsEnumeration) {
    EXPECT_TRUE(rc::check([] {
        const Values first = tied_values(1, 6), second = tied_values(1, 5);
        const auto difference = [](const Values& a, const Values& b) {
            // Multiplied by both sizes: halves and whole numbers, so nothing is rounded.
            return std::abs(std::reduce(a.begin(), a.end()) * static_cast<double>(b.size()) -
                            std::reduce(b.begin(), b.end()) * static_cast<double>(a.size()));
        };
        double hits = 0.0, deals = 0.0;
        for_each_deal(first, second, [&](const Values& a, const Values& b) {
            deals += 1.0;
            hits += difference(a, b) >= difference(first, second) ? 1.0 : 0.0;
        });
        const Outcome outcome = permutation_of_means(first, second);
        RC_ASSERT(outcome.exact);
        RC_ASSERT(std::abs(outcome.p - hits / deals) < 1e-14);
    }));
}

double pearson(const Values& x, const Values& y) {
    const auto n = static_cast<double>(x.size());
    const double mx = std::reduce(x.begin(), x.end()) / n, my = std::reduce(y.begin(), y.end()) / n;
    double xy = 0.0, xx = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mx) * (y[i] - my);
        xx += (x[i] - mx) * (x[i] - mx);
        yy += (y[i] - my) * (y[i] - my);
    }
    return xy / std::sqrt(xx * yy);
}

TEST(Spearman, CountsTheSamePairingsAsEnumeration) {
    EXPECT_TRUE(rc::check([] {
        const Values x = tied_values(2, 6);
        Values y;
        for (std::size_t i = 0; i < x.size(); ++i) y.push_back(*rc::gen::inRange(0, 6));
        const Outcome outcome = spearman(x, y);
        if (std::ranges::count(x, x[0]) == std::ssize(x) || std::ranges::count(y, y[0]) == std::ssize(y)) {
            RC_ASSERT(std::isnan(outcome.statistic) && std::isnan(outcome.p) && !outcome.undefined.empty());
            return;
        }
        const Values rx = midranks(x), ry = midranks(y);
        std::vector<std::size_t> order(x.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        double hits = 0.0, pairings = 0.0;
        do {
            Values paired;
            for (const std::size_t i : order) paired.push_back(ry[i]);
            pairings += 1.0;
            // Products of ranks are multiples of 1/4 and at most 91 in sum, so other correlations differ by 1e-3.
            hits += std::abs(pearson(rx, paired)) >= std::abs(pearson(rx, ry)) - 1e-9 ? 1.0 : 0.0;
        } while (std::ranges::next_permutation(order).found);
        RC_ASSERT(outcome.exact);
        RC_ASSERT(std::abs(outcome.statistic - pearson(rx, ry)) < 1e-12);
        RC_ASSERT(std::abs(outcome.p - hits / pairings) < 1e-14);
    }));
}

TEST(RankBiserial, IsTheShareOfGreaterPairsLessThatOfLesser) {
    EXPECT_TRUE(rc::check([] {
        const Values first = tied_values(1, 20), second = tied_values(1, 20);
        const Estimate estimate = rank_biserial(first, second);
        const double pairs = static_cast<double>(first.size() * second.size());
        RC_ASSERT(std::abs(estimate.value - (twice_u(first, second) / pairs - 1.0)) < 1e-12);
        const Estimate swapped = rank_biserial(second, first);
        RC_ASSERT(std::abs(estimate.value + swapped.value) < 1e-12);
        if (first.size() == 1 || second.size() == 1) {
            RC_ASSERT(std::isnan(estimate.low) && !estimate.undefined.empty());
            return;
        }
        RC_ASSERT(-1.0 <= estimate.low && estimate.low <= estimate.value + 1e-12);
        RC_ASSERT(estimate.value - 1e-12 <= estimate.high && estimate.high <= 1.0);
        RC_ASSERT(std::abs(estimate.low + swapped.high) < 1e-12);
    }));
}

TEST(HodgesLehmann, IsTheMedianOfAllDifferencesWithinTwoOfThem) {
    EXPECT_TRUE(rc::check([] {
        // Whole numbers of one step, far apart in size.
        const std::int64_t factor = *rc::gen::element<std::int64_t>(1, -1, 1'000'000'007, -3);
        const auto steps = [&](std::int64_t times) {
            std::vector<Int128> values;
            for (const double value : tied_values(1, 12))
                values.push_back(times * static_cast<std::int64_t>(2 * value));
            return values;
        };
        const std::vector<Int128> first = steps(factor), second = steps(1);
        Values doubled;  // twice each difference: whole, and below 2^53
        for (const Int128 a : first) {
            for (const Int128 b : second) doubled.push_back(2.0 * static_cast<double>(a - b));
        }
        std::ranges::sort(doubled);
        const std::size_t n = doubled.size(), half = n / 2;
        const double median = n % 2 == 1 ? doubled[half] : 0.5 * (doubled[half - 1] + doubled[half]);
        const Estimate estimate = hodges_lehmann(first, second, {.divisor = 2, .exponent = 0});
        RC_ASSERT(estimate.value == median / 4.0);
        RC_ASSERT(std::ranges::binary_search(doubled, 4.0 * estimate.low));
        RC_ASSERT(std::ranges::binary_search(doubled, 4.0 * estimate.high));
        RC_ASSERT(estimate.low <= estimate.value && estimate.value <= estimate.high);
        RC_ASSERT(estimate.exact);
        // Doubles are the decimals that they stand for: tenths of these steps.
        Values a, b;
        for (const Int128 value : first) a.push_back(static_cast<double>(value) / 10.0);
        for (const Int128 value : second) b.push_back(static_cast<double>(value) / 10.0);
        RC_ASSERT(hodges_lehmann(a, b).value == median / 20.0);
    }));
}

}  // namespace
}  // namespace burin::study
