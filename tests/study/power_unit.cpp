// SPDX-License-Identifier: MIT
// Simulated power against an integral, against the exact level, and with one and two threads.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/json.hpp"
#include "study/report/power_report.hpp"
#include "study/statistics/power.hpp"

namespace burin::study {
namespace {

// P(all of n from N(d, 1) exceed all of n from N(0, 1)): the integral over the least of the first,
// n phi(x - d) (1 - Phi(x - d))^(n - 1) Phi(x)^n dx, by trapezoids, which converge to rounding for such functions.
double all_exceed(int n, double d) {
    const auto upper = [](double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); };
    double sum = 0.0;
    const double step = 0.01;
    for (double x = d - 12.0; x < d + 12.0; x += step) {
        const double density = std::exp(-0.5 * (x - d) * (x - d)) / std::sqrt(2.0 * std::numbers::pi);
        sum += n * density * std::pow(upper(x - d), n - 1) * std::pow(upper(-x), n) * step;
    }
    return sum;
}

// Three against three at alpha 0.1: p is 2 / C(6, 3) = 0.1 where one group wholly exceeds the other, else larger.
TEST(Power, MeetsTheIntegralWhereOnlyFullSeparationCounts) {
    for (const double effect : {0.0, 0.7, 1.5, -1.5}) {
        const Power power = simulate_power(
            {.effect = effect, .first = 3, .second = 3, .alpha = 0.1, .studies = 100'000, .seed = 3, .threads = 2});
        const double expected = all_exceed(3, effect) + all_exceed(3, -effect);
        EXPECT_NEAR(power.level, 0.1, 1e-12);
        // Five standard errors: one of two million seeds would miss it.
        EXPECT_NEAR(power.power, expected, 5.0 * std::sqrt(expected * (1.0 - expected) / 100'000.0)) << effect;
    }
    EXPECT_NEAR(2.0 * all_exceed(3, 0.0), 0.1, 1e-9) << "the integral itself";
}

TEST(Power, GivesTheSameBitsWithOneAndTwoThreads) {
    PowerOptions options{.effect = 0.5, .first = 7, .second = 6, .studies = 5000, .seed = 11, .threads = 1};
    const Power one = simulate_power(options);
    options.threads = 2;
    const Power two = simulate_power(options);
    EXPECT_EQ(one.significant, two.significant);
    EXPECT_EQ(json_text(power_json(options, one)), json_text(power_json(options, two)));
    options.seed = 12;
    EXPECT_NE(simulate_power(options).significant, one.significant);
}

TEST(Power, FindsNoEffectNoOftenerThanTheExactLevel) {
    for (const std::size_t per_group : {5u, 10u, 30u}) {
        const Power power = simulate_power({.effect = 0.0, .first = per_group, .second = per_group, .studies = 1000});
        ASSERT_LE(power.level, 0.05);
        EXPECT_GT(power.level, 0.02) << "the largest level that ranks allow is near alpha";
        EXPECT_LE(power.power, power.level + 2.0 * std::sqrt(power.level * (1.0 - power.level) / 1000.0));
    }
}

TEST(Power, FindsTheFewestParticipants) {
    const PowerOptions options{.effect = 1.2, .studies = 4000, .seed = 5};
    const auto sizes = sizes_for_power(options, 0.8);
    ASSERT_TRUE(sizes.has_value());
    EXPECT_GE(sizes->power.power, 0.8);
    PowerOptions fewer = options;
    fewer.first = fewer.second = sizes->per_group - 1;
    EXPECT_LT(simulate_power(fewer).power, 0.8);
    // Two-sample t tests need 2 (1.960 + 0.842)^2 / 1.2^2 = 10.9 a group or little more; ranks need at least as many.
    EXPECT_GE(sizes->per_group, 11u);
    EXPECT_LE(sizes->per_group, 14u);
    EXPECT_FALSE(sizes_for_power({.effect = 0.0, .studies = 100}, 0.8).has_value());
}

TEST(Power, TakesGroupsThatCannotShowAnything) {
    const Power power = simulate_power({.effect = 5.0, .first = 1, .second = 2, .studies = 100});
    EXPECT_EQ(power.significant, 0u);
    EXPECT_EQ(power.level, 0.0);
}

TEST(Power, IsApproximateInLargeGroups) {
    const Power power = simulate_power({.effect = 0.0, .first = 100, .second = 100, .studies = 2000});
    EXPECT_TRUE(std::isnan(power.level));
    // Five standard errors of a share of 0.05.
    EXPECT_NEAR(power.power, 0.05, 5.0 * std::sqrt(0.05 * 0.95 / 2000.0));
}

}  // namespace
}  // namespace burin::study
