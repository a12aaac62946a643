// SPDX-License-Identifier: MIT
// What each procedure gives where there is little or nothing to compute with, and cases that can be worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "study/statistics/agreement.hpp"
#include "study/statistics/effect_size.hpp"
#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/outcome.hpp"
#include "study/statistics/permutation.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/spearman.hpp"

namespace burin::study {
namespace {

using Values = std::vector<double>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Values counted_up(std::size_t n, double from = 1.0) {
    Values values(n);
    std::iota(values.begin(), values.end(), from);
    return values;
}

void expect_undefined(const Outcome& outcome, const std::string& reason) {
    EXPECT_TRUE(std::isnan(outcome.statistic)) << outcome.method;
    EXPECT_TRUE(std::isnan(outcome.p)) << outcome.method;
    EXPECT_NE(outcome.undefined.find(reason), std::string::npos) << outcome.method << ": " << outcome.undefined;
    EXPECT_FALSE(outcome.exact) << outcome.method;
}

void expect_undefined(const Estimate& estimate, const std::string& reason) {
    EXPECT_TRUE(std::isnan(estimate.value)) << estimate.method;
    EXPECT_TRUE(std::isnan(estimate.low)) << estimate.method;
    EXPECT_TRUE(std::isnan(estimate.high)) << estimate.method;
    EXPECT_NE(estimate.undefined.find(reason), std::string::npos) << estimate.method << ": " << estimate.undefined;
}

TEST(Statistics, SayWhyAnEmptyGroupHasNoResult) {
    const Values some{1, 2, 3};
    for (const auto& [a, b] : {std::pair(Values{}, some), std::pair(some, Values{}), std::pair(Values{}, Values{})}) {
        expect_undefined(mann_whitney(a, b), "empty");
        expect_undefined(mann_whitney_normal(a, b), "empty");
        expect_undefined(permutation_of_means(a, b), "empty");
        expect_undefined(rank_biserial(a, b), "empty");
        expect_undefined(hodges_lehmann(a, b), "empty");
    }
    expect_undefined(spearman(Values{}, Values{}), "fewer than two");
    expect_undefined(intraclass_correlation({}), "fewer than two participants");
}

TEST(Statistics, SayWhyAValueThatIsNotFiniteHasNoResult) {
    const Values some{1, 2, 3};
    for (const double bad : {kUndefined, kInfinity, -kInfinity}) {
        const Values with_bad{1, bad, 3};
        expect_undefined(mann_whitney(with_bad, some), "finite");
        expect_undefined(mann_whitney_normal(some, with_bad), "finite");
        expect_undefined(permutation_of_means(with_bad, some), "finite");
        expect_undefined(rank_biserial(some, with_bad), "finite");
        expect_undefined(hodges_lehmann(with_bad, some), "finite");
        expect_undefined(spearman(with_bad, some), "finite");
        expect_undefined(spearman(some, with_bad), "finite");
        const std::vector<Values> participants{{1, 2}, {bad, 3}};
        expect_undefined(intraclass_correlation(participants), "finite");
    }
}

TEST(Statistics, FindNoDifferenceWhereAllValuesAreEqual) {
    const Values four(4, 0.1), three(3, 0.1);
    EXPECT_EQ(mann_whitney(four, three).p, 1.0);
    EXPECT_EQ(mann_whitney(four, three).statistic, 6.0);
    EXPECT_EQ(mann_whitney_normal(four, three).p, 1.0);
    EXPECT_EQ(permutation_of_means(four, three).p, 1.0);
    EXPECT_EQ(rank_biserial(four, three).value, 0.0);
    EXPECT_EQ(hodges_lehmann(four, three).value, 0.0);
    EXPECT_EQ(hodges_lehmann(four, three).low, 0.0);
    expect_undefined(spearman(three, three), "equal");
    const std::vector<Values> participants(3, Values(2, 0.1));
    expect_undefined(intraclass_correlation(participants), "equal");
}

TEST(Statistics, TakeOneValueAGroup) {
    const Values one{1}, two{2};
    EXPECT_EQ(mann_whitney(one, two).statistic, 0.0);
    EXPECT_EQ(mann_whitney(one, two).p, 1.0);  // two deals, equally far
    EXPECT_EQ(permutation_of_means(one, two).p, 1.0);
    EXPECT_EQ(rank_biserial(one, two).value, -1.0);
    EXPECT_TRUE(std::isnan(rank_biserial(one, two).low));
    EXPECT_EQ(hodges_lehmann(one, two).value, -1.0);
    EXPECT_EQ(hodges_lehmann(one, two).confidence, 0.0);  // one difference: its interval covers nothing for sure
    expect_undefined(spearman(one, two), "fewer than two");
}

TEST(MannWhitney, HasTheLeastProbabilityWhereGroupsAreApart) {
    // Two of all C(20, 10) = 184,756 deals are as far apart.
    const Outcome apart = mann_whitney(counted_up(10), counted_up(10, 100.0));
    EXPECT_EQ(apart.statistic, 0.0);
    EXPECT_DOUBLE_EQ(apart.p, 2.0 / 184756.0);
    EXPECT_TRUE(apart.exact);
}

TEST(MannWhitney, SaysThatItApproximatesBeyondItsLimit) {
    const Outcome exact = mann_whitney(counted_up(50), counted_up(50, 4.5));
    EXPECT_TRUE(exact.exact);
    const Outcome beyond = mann_whitney(counted_up(50), counted_up(51, 4.5));
    EXPECT_FALSE(beyond.exact);
    EXPECT_NE(beyond.method.find("normal"), std::string::npos);
    // With 50 in each group the approximation is within its error of 1/n of the exact probability.
    EXPECT_NEAR(exact.p, mann_whitney_normal(counted_up(50), counted_up(50, 4.5)).p, 0.02);
}

TEST(Spearman, HasTheLeastProbabilityWherePairsRiseOrFall) {
    double pairings = 1.0;
    for (std::size_t n = 2; n <= kExactPairs; ++n) {
        pairings *= static_cast<double>(n);
        const Values up = counted_up(n), down(up.rbegin(), up.rend());
        EXPECT_EQ(spearman(up, up).statistic, 1.0);
        EXPECT_EQ(spearman(up, down).statistic, -1.0);
        EXPECT_DOUBLE_EQ(spearman(up, down).p, 2.0 / pairings) << n;
    }
}

TEST(Spearman, SamplesPairingsByItsSeedBeyondItsLimit) {
    const Values x = counted_up(13);
    const Values y{3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8, 9};
    const Outcome one = spearman(x, y, 7), same = spearman(x, y, 7), other = spearman(x, y, 8);
    EXPECT_FALSE(one.exact);
    EXPECT_NE(one.method.find("seed 7"), std::string::npos) << one.method;
    EXPECT_EQ(one.p, same.p);
    EXPECT_NE(one.p, other.p);
    // Six standard errors of a share of 99,999 draws, twice.
    EXPECT_NEAR(one.p, other.p, 12.0 * std::sqrt(0.25 / 99999.0));
}

TEST(PermutationOfMeans, SamplesDealsByItsSeedWhereThereAreTooMany) {
    const Values a = counted_up(15), b = counted_up(15, 4.5);
    const Outcome one = permutation_of_means(a, b, 7), same = permutation_of_means(a, b, 7);
    EXPECT_FALSE(one.exact);
    EXPECT_EQ(one.p, same.p);
    const Outcome many = permutation_of_means(counted_up(101), counted_up(100, 4.5));
    EXPECT_NE(many.method.find("normal"), std::string::npos) << many.method;
    // Below that limit the sample gives what the normal distribution gives, but for the sample's error (six standard
    // errors) and the approximation's, of the order of 1 / n.
    const Values first = counted_up(100), second = counted_up(100, 4.5);
    const Outcome sampled = permutation_of_means(first, second);
    EXPECT_NE(sampled.method.find("random deals"), std::string::npos) << sampled.method;
    double squares = 0.0;  // about the common mean, 52.25
    for (const Values& group : {first, second}) {
        for (const double value : group) squares += (value - 52.25) * (value - 52.25);
    }
    const double z = 3.5 / std::sqrt(squares / 199.0 * (1.0 / 100.0 + 1.0 / 100.0));
    EXPECT_NEAR(sampled.p, std::erfc(z / std::sqrt(2.0)), 6.0 * std::sqrt(0.25 / 99999.0) + 0.005);
}

TEST(Spearman, UsesStudentsTInLargeTables) {
    Values x = counted_up(kSampledPairs + 1), y = x;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = static_cast<double>(i * 37 % 101);
    const Outcome outcome = spearman(x, y);
    EXPECT_NE(outcome.method.find("Student"), std::string::npos) << outcome.method;
    EXPECT_GT(outcome.p, 0.0);
    EXPECT_LT(outcome.p, 1.0);
    EXPECT_EQ(spearman(x, x).p, 0.0);
}

TEST(HodgesLehmann, TakesEveryDifferenceIntoItsIntervalWhereValuesAreFew) {
    // Of 3 and 3 the interval from the least to the greatest difference reaches 1 - 2 / C(6, 3) = 0.9, not 0.95.
    const Estimate few = hodges_lehmann(Values{1, 2, 4}, Values{10, 20, 40});
    EXPECT_EQ(few.low, -39.0);
    EXPECT_EQ(few.high, -6.0);
    EXPECT_DOUBLE_EQ(few.confidence, 0.9);
}

TEST(Agreement, IsOneWhereTrialsAgreeAndBelowZeroWhereOnlyTheyDiffer) {
    const std::vector<Values> agree{{1, 1}, {2, 2}, {5, 5}}, differ{{1, 3}, {3, 1}, {1, 3}};
    const Estimate one = intraclass_correlation(agree);
    EXPECT_EQ(one.value, 1.0);
    EXPECT_EQ(one.low, 1.0);
    EXPECT_EQ(one.high, 1.0);
    EXPECT_EQ(intraclass_correlation(differ).value, -1.0);
    const std::vector<Values> uneven{{1, 2}, {2, 3, 4}}, single{{1}, {2}};
    // R's anova gives the mean squares 2.7 and 2.5 / 3; k0 = 5 - 13 / 5.
    EXPECT_NEAR(intraclass_correlation(uneven).value, (2.7 - 2.5 / 3.0) / (2.7 + 1.4 * 2.5 / 3.0), 1e-12);
    expect_undefined(intraclass_correlation(single), "fewer than two trials");
}

}  // namespace
}  // namespace burin::study
