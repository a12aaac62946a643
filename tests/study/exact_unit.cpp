// SPDX-License-Identifier: MIT
// What is computed of decimals without rounding: ties, U, r, r_s, shifts, medians and means against whole-number
// arithmetic, on random studies and on the cases that a rounded mean gets wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "study/analysis/analysis.hpp"
#include "study/report/analysis_tables.hpp"
#include "study/statistics/agreement.hpp"
#include "study/statistics/effect_size.hpp"
#include "study/statistics/exact.hpp"
#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/permutation.hpp"
#include "study/statistics/ranks.hpp"
#include "study/statistics/spearman.hpp"
#include "study/table/trial_table.hpp"
#include "tests/study/decimal_studies.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::study {
namespace {

using test_decimals::DecimalPerson;
using test_decimals::DecimalStudy;
using test_decimals::Twelfths;

constexpr std::size_t kRandomStudies = 400;
constexpr double kNormal975 = 1.959963984540054;

Analysis analysis_of_table(const std::string& text) {
    const ParsedTable parsed = parse_trials(text);
    EXPECT_TRUE(parsed.faults.empty()) << text << line_of(parsed.faults.at(0), "");
    return analyse(parsed.table);
}

// ---- 400 random studies

// The double nearest to `numerator` of that many parts of the study's unit: both are whole and below 2^53.
double of_unit(std::int64_t numerator, std::int64_t parts, const DecimalStudy& study) {
    return static_cast<double>(numerator) / static_cast<double>(parts * test_decimals::kTwelfths * study.scale());
}

void expect_exact_comparison(const Comparison& c, const DecimalStudy& study, const Twelfths& first,
                             const Twelfths& second) {
    const auto pairs = static_cast<std::int64_t>(first.size() * second.size());
    const std::int64_t twice_u = test_decimals::doubled_u(first, second);
    EXPECT_EQ(c.mann_whitney.statistic, 0.5 * static_cast<double>(twice_u));
    EXPECT_EQ(c.mann_whitney_normal.statistic, c.mann_whitney.statistic);
    EXPECT_EQ(c.rank_biserial.value, static_cast<double>(twice_u - pairs) / static_cast<double>(pairs));
    EXPECT_EQ(c.hodges_lehmann.value, of_unit(test_decimals::doubled_shift(first, second), 2, study));
    EXPECT_EQ(c.median_first, of_unit(test_decimals::doubled_median(first), 2, study));
    EXPECT_EQ(c.median_second, of_unit(test_decimals::doubled_median(second), 2, study));
}

void expect_exact_correlation(const Outcome& r, const Twelfths& times, const Twelfths& deviations) {
    const double exact = test_decimals::spearman_of(times, deviations);
    if (std::isnan(exact)) {
        EXPECT_TRUE(std::isnan(r.statistic)) << r.statistic;
    } else {
        EXPECT_EQ(r.statistic, exact);
    }
}

void expect_exact_unit(const UnitAnalysis& unit, const DecimalStudy& study) {
    const bool means = unit.unit == Unit::participant;
    const auto values = [&](int group, std::vector<std::int64_t> DecimalPerson::* measure) {
        return study.values(group, measure, means);
    };
    ASSERT_EQ(unit.comparisons.size(), 2u);
    expect_exact_comparison(unit.comparisons[0], study, values(0, &DecimalPerson::times),
                            values(1, &DecimalPerson::times));
    expect_exact_comparison(unit.comparisons[1], study, values(0, &DecimalPerson::deviations),
                            values(1, &DecimalPerson::deviations));
    for (const int group : {0, 1}) {
        expect_exact_correlation(unit.groups[static_cast<std::size_t>(group)].deviation_with_time,
                                 values(group, &DecimalPerson::times), values(group, &DecimalPerson::deviations));
    }
}

TEST(ExactStudy, HasTheFiguresOfWholeNumbersIn400RandomStudies) {
    const auto studies = test_decimals::random_decimal_studies(kRandomStudies, test::property_cases().seed);
    std::size_t with_ties = 0;
    for (const DecimalStudy& study : studies) {
        const Analysis analysis = analysis_of_table(study.csv());
        expect_exact_unit(analysis.participants, study);
        expect_exact_unit(analysis.trials, study);
        with_ties += std::fmod(analysis.participants.comparisons[1].mann_whitney.statistic, 1.0) > 0.0 ? 1 : 0;
        if (HasFailure()) FAIL() << study.csv();
    }
    EXPECT_GT(with_ties, kRandomStudies / 10);
}

TEST(ExactStudy, RanksInItsTablesAreThoseOfWholeNumbers) {
    for (const DecimalStudy& study : test_decimals::random_decimal_studies(40, 7)) {
        Twelfths pooled = study.values(0, &DecimalPerson::deviations, true);
        const Twelfths second = study.values(1, &DecimalPerson::deviations, true);
        pooled.insert(pooled.end(), second.begin(), second.end());
        const std::vector<std::int64_t> ranks = test_decimals::twice_ranks(pooled);
        const std::string table = analysis_tables(analysis_of_table(study.csv()))[3].text;
        std::size_t at = table.find('\n') + 1;
        for (const std::int64_t twice : ranks) {
            const std::string line = table.substr(at, table.find('\n', at) - at);
            at += line.size() + 1;
            EXPECT_EQ(std::stod(line.substr(line.rfind(',') + 1)), 0.5 * static_cast<double>(twice)) << line;
        }
    }
}

// ---- Means that tie

// Groups of people with the trials 0.1, 0.2, 0.3 in one order and in the other.
std::string table_of_orders(int people) {
    std::string text = "participant,group,trial,deviation_mm,time_s\n";
    for (int i = 0; i < 2 * people; ++i) {
        for (int trial = 1; trial <= 3; ++trial) {
            const int tenths = i < people ? trial : 4 - trial;
            text += formatted("p%d,%s,%d,0.%d,%d.%d\n", i, i < people ? "A" : "B", trial, tenths, tenths, tenths);
        }
    }
    return text;
}

TEST(ExactStudy, TiesMeansOfTheSameTrialsInAnotherOrder) {
    const Analysis analysis = analysis_of_table(table_of_orders(4));
    for (const Comparison& c : analysis.participants.comparisons) {
        EXPECT_EQ(c.mann_whitney.statistic, 8.0);
        EXPECT_EQ(c.mann_whitney.p, 1.0);
        EXPECT_EQ(c.mann_whitney_normal.p, 1.0);
        EXPECT_EQ(c.rank_biserial.value, 0.0);
        EXPECT_EQ(c.hodges_lehmann.value, 0.0);
        EXPECT_EQ(c.hodges_lehmann.low, 0.0);
        EXPECT_EQ(c.hodges_lehmann.high, 0.0);
        EXPECT_EQ(c.difference_of_means.statistic, 0.0);
        EXPECT_EQ(c.difference_of_means.p, 1.0);
        EXPECT_EQ(c.median_first, c.median_second);
    }
    EXPECT_EQ(analysis.participants.comparisons[1].median_first, 0.2);
    for (const GroupSummary& group : analysis.participants.groups)
        EXPECT_FALSE(group.deviation_with_time.undefined.empty());
    // With many the normal approximation of the permutation test must not divide rounding by rounding.
    const Analysis many = analysis_of_table(table_of_orders(120));
    for (const Comparison& c : many.participants.comparisons) {
        EXPECT_EQ(c.difference_of_means.p, 1.0);
        EXPECT_EQ(c.mann_whitney.p, 1.0);
    }
}

// U of one pair of trials: 0 where the first is less, 1/2 where they tie, 1 where it is greater.
double u_of_two(const std::string& first, const std::string& second) {
    const std::string head = "participant,group,trial,deviation,time_s\na,A,1,";
    return analysis_of_table(head + first + ",1\nb,B,1," + second + ",1\n")
        .participants.comparisons[1]
        .mann_whitney.statistic;
}

TEST(ExactStudy, TellsNumbersThatDifferInTheLastDecimal) {
    EXPECT_EQ(u_of_two("0.30000", "0.3"), 0.5);
    EXPECT_EQ(u_of_two("3e-1", "0.3"), 0.5);
    EXPECT_EQ(u_of_two("300e-3", "0.003E+2"), 0.5);
    EXPECT_EQ(u_of_two("0.3", "0.30001"), 0.0);
    EXPECT_EQ(u_of_two("0.30000000000000002", "0.30000000000000001"), 1.0);  // one double
    EXPECT_EQ(u_of_two("123456.12345678901234567890", "123456.12345678901234567891"), 0.0);
    EXPECT_EQ(u_of_two("1e-300", "2e-300"), 0.0);
    EXPECT_EQ(u_of_two("0", "0.000"), 0.5);
    EXPECT_EQ(u_of_two("0", "1e-25"), 0.0);
    EXPECT_EQ(u_of_two("1000000000", "999999999.99999999999"), 1.0);
}

TEST(ExactStudy, TellsMeansOfDifferentNumbersOfTrials) {
    // 0.1 and 0.2 against 0.1, 0.1 and 0.25: both 0.15. The last decimal of one more, and they differ.
    const auto u = [](const char* last) {
        return analysis_of_table(std::string("participant,group,trial,deviation,time_s\na,A,1,0.1,1\na,A,2,0.2,1\n"
                                             "b,B,1,0.1,1\nb,B,2,0.1,1\nb,B,3,") +
                                 last + ",1\n")
            .participants.comparisons[1]
            .mann_whitney.statistic;
    };
    EXPECT_EQ(u("0.25"), 0.5);
    EXPECT_EQ(u("0.250000000000000001"), 0.0);
    EXPECT_EQ(u("0.249999999999999999"), 1.0);
}

TEST(ExactStudy, TiesMeansOfManyTrialsWhoseNumbersHaveNoSmallMultiple) {
    // 37, 41, 43, 47, 53 and 59 trials of 0.7: no common divisor below 10^9 there, and all means are 0.7.
    std::string text = "participant,group,trial,deviation,time_s\n";
    const int counts[] = {37, 41, 43, 47, 53, 59};
    for (std::size_t p = 0; p < std::size(counts); ++p) {
        for (int i = 1; i <= counts[p]; ++i) text += formatted("p%zu,%s,%d,0.7,1.3\n", p, p % 2 == 0 ? "A" : "B", i);
    }
    const Comparison c = analysis_of_table(text).participants.comparisons[1];
    EXPECT_EQ(c.mann_whitney.statistic, 4.5);
    EXPECT_EQ(c.hodges_lehmann.value, 0.0);
    EXPECT_EQ(c.median_first, 0.7);
}

// ---- Statistics of doubles, which stand for their shortest decimals

TEST(ExactStatistics, TakeDoublesAsTheDecimalsTheyStandFor) {
    const std::vector<double> a{0.3, -0.1, 1e-3, -2.5}, b{0.1, -0.3, -1e-3, -2.6};
    // -0.1 - -0.3 and 0.3 - 0.1 are both 0.2, though not as doubles; -2.5 - -2.6 is 0.1.
    EXPECT_EQ(hodges_lehmann(std::vector{0.3}, std::vector{0.1}).value, 0.2);
    EXPECT_EQ(hodges_lehmann(std::vector{-0.1}, std::vector{-0.3}).value, 0.2);
    EXPECT_EQ(hodges_lehmann(std::vector{-2.5}, std::vector{-2.6}).value, 0.1);
    EXPECT_EQ(permutation_of_means(std::vector{0.1, 0.2, 0.3}, std::vector{0.3, 0.2, 0.1}).statistic, 0.0);
    EXPECT_EQ(permutation_of_means(a, b).statistic, 0.1255);
    // Two deals of four whose sums are 0.4 and 0.2 + 0.2: with doubles they differ.
    EXPECT_EQ(permutation_of_means(std::vector{0.1, 0.3}, std::vector{0.2, 0.2}).p, 1.0);
}

TEST(ExactStatistics, PermutationTellsSumsThatDifferInTheirLastDecimal) {
    // Of the six deals two are 1e-13 apart and four not at all; a tolerance of 1e-12 would see six alike.
    const std::vector<double> a{1.0000000000001, 1.0000000000001}, b{1.0, 1.0};
    EXPECT_EQ(permutation_of_means(a, b).p, 2.0 / 6.0);
}

TEST(ExactStatistics, MedianOfAnEvenNumberIsTheMeanOfTheTwoInTheMiddle) {
    const std::string text =
        "participant,group,trial,deviation_mm,time_s\na,A,1,0.1,1\nb,A,1,0.2,2\nc,A,1,0.4,4\nd,A,1,8,8\n"
        "e,B,1,1,10\nf,B,1,3,30\ng,B,1,2,20\nh,B,1,9,90\n";
    const UnitAnalysis unit = analysis_of_table(text).participants;
    EXPECT_EQ(unit.comparisons[0].median_first, 3.0);
    EXPECT_EQ(unit.comparisons[0].median_second, 25.0);
    EXPECT_EQ(unit.comparisons[1].median_first, 0.3);  // (0.2 + 0.4) / 2 of doubles is 0.30000000000000004
    EXPECT_EQ(unit.comparisons[1].median_second, 2.5);
}

// ---- Groups without overlap, and groups that are alike

TEST(ExactStatistics, IntervalOfSeparatedGroupsIsThatOfTheirSizesForAllSizes) {
    for (int n1 = 2; n1 <= 15; ++n1) {
        for (int n2 = 2; n2 <= 15; ++n2) {
            std::vector<double> high, low;
            for (int i = 0; i < n1; ++i) high.push_back(100.1 + 0.1 * i);
            for (int i = 0; i < n2; ++i) low.push_back(1.1 + 0.1 * i);
            const double n = std::min(n1, n2), z2 = kNormal975 * kNormal975, inner = (n - z2) / (n + z2);
            const Estimate up = rank_biserial(high, low), down = rank_biserial(low, high);
            EXPECT_EQ(up.value, 1.0);
            EXPECT_NEAR(up.low, inner, 1e-12) << n1 << " and " << n2;
            EXPECT_EQ(up.high, 1.0);
            EXPECT_EQ(down.value, -1.0);
            EXPECT_EQ(down.low, -1.0);
            EXPECT_NEAR(down.high, -inner, 1e-12) << n1 << " and " << n2;
        }
    }
    EXPECT_NEAR(rank_biserial(std::vector<double>{11, 12, 13, 14, 15, 16, 17, 18, 19, 20},
                              std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10})
                    .low,
                0.4449, 5e-5);
}

TEST(ExactStatistics, GroupsThatAreAlikeDifferByNothing) {
    for (int n = 2; n <= 30; ++n) {
        std::vector<double> group;
        for (int i = 0; i < n; ++i) group.push_back(0.1 * i);
        EXPECT_EQ(rank_biserial(group, group).value, 0.0) << n;
        EXPECT_EQ(mann_whitney(group, group).p, 1.0) << n;
        EXPECT_EQ(hodges_lehmann(group, group).value, 0.0) << n;
        EXPECT_EQ(spearman(group, group).statistic, 1.0) << n;
        if (n <= 8) {
            EXPECT_EQ(permutation_of_means(group, group).p, 1.0) << n;
        }
    }
}

TEST(ExactStatistics, IntervalReachesAProbabilityThatIsExactlyTheWish) {
    // Of three against three P(U <= 1) = 2 / 20, just what a confidence of 0.8 leaves on either side.
    const Estimate shift = hodges_lehmann(std::vector<double>{1, 2, 4}, std::vector<double>{10, 20, 40}, 0.8);
    EXPECT_NEAR(shift.confidence, 0.8, 1e-15);
    EXPECT_EQ(shift.low, 1.0 - 40.0 + 1.0);  // the second least of all differences
}

TEST(ExactStatistics, IntervalOfLargeSamplesIsTheOneOfTheExactDistribution) {
    // Sizes at which the approximation is as good as the count of all deals; at others it may be one step off.
    for (const auto& [n1, n2] : {std::pair(51, 51), std::pair(40, 70), std::pair(90, 30)}) {
        std::vector<double> first, second, differences;
        for (int i = 0; i < n1; ++i) first.push_back(0.37 * i * i);
        for (int i = 0; i < n2; ++i) second.push_back(0.41 * i * i + 0.013 * i);
        for (const double a : first) {
            for (const double b : second) differences.push_back(a - b);
        }
        std::ranges::sort(differences);
        // The largest k with P(U <= k - 1) <= 0.025, by counting all deals.
        std::vector<std::int64_t> ranks(first.size() + second.size());
        std::iota(ranks.begin(), ranks.end(), std::int64_t{1});
        const std::vector<double> counts = rank_sum_counts(ranks, first.size());
        const double ways = std::accumulate(counts.begin(), counts.end(), 0.0);
        std::size_t k = 0;
        double below = 0.0;
        for (std::size_t sum = first.size() * (first.size() + 1) / 2; (below += counts[sum] / ways) <= 0.025; ++sum)
            ++k;
        const Estimate shift = hodges_lehmann(first, second);
        EXPECT_FALSE(shift.exact);
        EXPECT_NEAR(shift.low, differences[k - 1], 1e-9) << n1 << " and " << n2;
        EXPECT_NEAR(shift.high, differences[differences.size() - k], 1e-9) << n1 << " and " << n2;
    }
}

// ---- Agreement

TEST(ExactStatistics, AgreementOfUnequalNumbersOfTrialsIsThatOfTheAnalysisOfVariance) {
    // By R: F of anova(lm(value ~ participant)), k0, and the ends from qf(0.975, ...).
    const std::vector<std::vector<double>> people{{7.642, 11.339, 9.713, 12.202},
                                                  {15.713, 13.796, 11.523},
                                                  {13.486, 17.393, 15.179, 16.116, 16.319},
                                                  {18.23, 23.051},
                                                  {22.351},
                                                  {29.034, 23.752, 22.081, 26.334},
                                                  {26.1, 29.323, 27.225, 28.447, 27.138, 31.01},
                                                  {30.096, 31.956, 30.08},
                                                  {33.807, 34.425}};
    const Estimate icc = intraclass_correlation(people);
    EXPECT_NEAR(icc.value, 0.9412239, 5e-8);
    EXPECT_NEAR(icc.low, 0.8430461, 5e-8);
    EXPECT_NEAR(icc.high, 0.9847856, 5e-8);
    EXPECT_TRUE(icc.undefined.empty()) << icc.undefined;
}

TEST(ExactStatistics, AgreementIsOneWhereEachPersonRepeatsOneValue) {
    const Estimate icc = intraclass_correlation(std::vector<std::vector<double>>{{0.1, 0.1, 0.1}, {0.7, 0.7, 0.7}});
    EXPECT_EQ(icc.value, 1.0);
    EXPECT_EQ(icc.low, 1.0);
    EXPECT_EQ(icc.high, 1.0);
    // And as low as it can be where all means are equal: -1 / (k - 1).
    EXPECT_EQ(intraclass_correlation(std::vector<std::vector<double>>{{0.1, 0.2, 0.3}, {0.3, 0.2, 0.1}}).value, -0.5);
}

// ---- Decimals

TEST(Decimals, AreReadAsTheyAreWritten) {
    EXPECT_EQ(decimal_of("-12.50"), (Decimal{-125, -1}));
    EXPECT_EQ(decimal_of("4.5e-3"), (Decimal{45, -4}));
    EXPECT_EQ(decimal_of(".5"), (Decimal{5, -1}));
    EXPECT_EQ(decimal_of("5."), (Decimal{5, 0}));
    EXPECT_EQ(decimal_of("1200E+2"), (Decimal{12, 4}));
    EXPECT_EQ(decimal_of("-0.00"), Decimal{});
    EXPECT_EQ(decimal_of("0e999999999999"), Decimal{});
    EXPECT_EQ(decimal_of(0.1), (Decimal{1, -1}));
    EXPECT_EQ(decimal_of(-1e300), (Decimal{-1, 300}));
    EXPECT_EQ(decimal_of(std::string(60, '9')).exponent, 24);  // 36 digits are kept
    // What is no number gives some decimal, and no more.
    for (const char* none : {"", "-", "e", "1e", "1e+", "abc", "1.2.3", "1e99999999999"}) (void)decimal_of(none);
}

TEST(Decimals, AreWorthTheNearestDouble) {
    EXPECT_EQ(value_of(1, {.divisor = 3, .exponent = 0}), 1.0 / 3.0);
    EXPECT_EQ(value_of(-2, {.divisor = 3, .exponent = -1}), -2.0 / 30.0);
    EXPECT_EQ(value_of(5, {.divisor = 1, .exponent = -1}, 2), 0.25);
    EXPECT_EQ(value_of(1, {.divisor = 1, .exponent = -400}), 0.0);
    EXPECT_EQ(value_of(0, {}), 0.0);
    // Halfway between two doubles to the even one, and a step beyond upwards.
    EXPECT_EQ(value_of((Int128{1} << 53) + 1, {}), 0x1p53);
    EXPECT_EQ(value_of(((Int128{1} << 53) + 1) * 1000 + 1, {.divisor = 1000, .exponent = 0}), 0x1p53 + 2.0);
}

TEST(Decimals, OfAllSizesInOneListTieWhereEqualAndKeepTheirOrder) {
    // Too far apart for one grid: what does not fit is rounded, equal values stay equal.
    const ExactValues values = exact_values(std::vector<double>{1e9, 1e-300, 2e-300, 0.1, 0.1, 1e9, -1e9});
    EXPECT_EQ(values.steps[0], values.steps[5]);
    EXPECT_EQ(values.steps[3], values.steps[4]);
    EXPECT_GT(values.steps[3], values.steps[1]);
    EXPECT_LT(values.steps[6], values.steps[1]);
    EXPECT_EQ(values.value(0), 1e9);
    EXPECT_EQ(values.value(3), 0.1);
}

}  // namespace
}  // namespace burin::study
