// SPDX-License-Identifier: MIT
// Metrics of a trial against closed forms, against the figures of another program, and where nothing is defined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "study/metrics/path.hpp"
#include "study/metrics/smoothness.hpp"
#include "study/metrics/trial_metrics.hpp"
#include "study/statistics/outcome.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::study {
namespace {

using Points = std::vector<Vec3>;

// Samples of f at from, from + 1 / rate, ...
template <typename F>
std::vector<double> sampled(std::size_t n, double from, double rate_hz, F&& f) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(f(from + static_cast<double>(i) / rate_hz));
    return values;
}

double bell(double t) { return std::exp(-5.0 * t * t); }
double least_jerk_speed(double t) { return 30.0 * t * t * (1.0 - t) * (1.0 - t); }

// The figures of smoothness.py in https://github.com/siva82kb/SPARC, run on these profiles.
TEST(Smoothness, MeetsTheFiguresOfItsAuthorsProgram) {
    const std::vector<double> bells = sampled(200, -1.0, 100.0, bell);
    // Both sum the same numbers in another order: rounding of 200 terms, through second differences of 1e4.
    EXPECT_NEAR(spectral_arc_length(bells, 100.0), -1.4140312617104789, 1e-11);
    EXPECT_NEAR(dimensionless_jerk(bells, 100.0), -335.7468370326857, 1e-8);
    EXPECT_NEAR(log_dimensionless_jerk(bells, 100.0), -5.816357414756398, 1e-10);
    const std::vector<double> least_jerk = sampled(1000, 0.0, 1000.0, least_jerk_speed);
    // NumPy agrees with us to 1e-15 here (reference_unit.cpp compares others); this figure was noted down to 1e-10.
    EXPECT_NEAR(spectral_arc_length(least_jerk, 1000.0), -1.4024260628709, 1e-10);
    EXPECT_NEAR(dimensionless_jerk(least_jerk, 1000.0), -202.76628283962, 1e-6);
}

TEST(Smoothness, OfTheMovementOfLeastJerkTendsToItsClosedForm) {
    // T^3 / v^2 times the integral of (60 - 360 t + 360 t^2)^2, with v = 15 / 8: 720 / (15 / 8)^2 = 204.8. Two samples
    // at the ends are lost to the second difference, so that the error halves with the interval.
    double before = 0.0;
    for (const std::size_t n : {1000u, 2000u, 4000u}) {
        const auto rate = static_cast<double>(n);
        const double error = 204.8 + dimensionless_jerk(sampled(n, 0.0, rate, least_jerk_speed), rate);
        EXPECT_GT(error, 0.0);
        if (before > 0.0) {
            EXPECT_NEAR(error / before, 0.5, 0.05);
        }
        before = error;
    }
    EXPECT_LT(before, 1.0);
}

// Neither the size of a movement nor, for the same curve over a longer time, its duration matters.
TEST(Smoothness, DoesNotDependOnSizeAndSeesASecondMovement) {
    const std::vector<double> one = sampled(200, -1.0, 100.0, bell);
    std::vector<double> larger = one;
    for (double& speed : larger) speed *= 7.0;
    EXPECT_NEAR(spectral_arc_length(larger, 100.0), spectral_arc_length(one, 100.0), 1e-12);
    EXPECT_NEAR(dimensionless_jerk(larger, 100.0), dimensionless_jerk(one, 100.0), 1e-9);
    EXPECT_NEAR(dimensionless_jerk(one, 50.0), dimensionless_jerk(one, 100.0), 1e-9);
    const std::vector<double> two = sampled(400, -2.0, 100.0, [](double t) { return bell(t - 0.9) + bell(t + 0.9); });
    EXPECT_LT(spectral_arc_length(two, 100.0), spectral_arc_length(one, 100.0) - 0.1);
    EXPECT_LT(log_dimensionless_jerk(two, 100.0), log_dimensionless_jerk(one, 100.0));
}

TEST(Smoothness, IsUndefinedWhereNothingMoves) {
    for (const std::vector<double>& speeds :
         {std::vector<double>{}, {1.0, 2.0}, {0.0, 0.0, 0.0, 0.0}, {1.0, kUndefined, 1.0}}) {
        EXPECT_TRUE(std::isnan(spectral_arc_length(speeds, 100.0)));
        EXPECT_TRUE(std::isnan(dimensionless_jerk(speeds, 100.0)));
        EXPECT_TRUE(std::isnan(log_dimensionless_jerk(speeds, 100.0)));
    }
    EXPECT_TRUE(std::isnan(spectral_arc_length(std::vector<double>{1, 2, 1}, 0.0)));
    EXPECT_TRUE(std::isnan(spectral_arc_length(std::vector<double>{1, 2, 1}, kUndefined)));
    EXPECT_TRUE(std::isnan(spectral_arc_length(std::vector<double>(kMostSpectrumSamples + 1, 1.0), 1000.0)));
    EXPECT_TRUE(speeds_m_per_s({}, 100.0).empty());
}

Points half_circle(double radius, std::size_t n, double height = 0.0) {
    Points points;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(n - 1);
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    return points;
}

TEST(Path, HasTheLengthAndEconomyOfAHalfCircle) {
    const Points path = half_circle(0.1, 10'001);
    EXPECT_NEAR(path_length_m(path), 0.1 * std::numbers::pi, 1e-8);  // chords are shorter by (pi / 10^4)^2 / 24
    EXPECT_NEAR(economy_of_path(path), 2.0 / std::numbers::pi, 1e-7);
    EXPECT_NEAR(economy_of_path(path, 0.1), 1.0 / std::numbers::pi, 1e-7);
}

TEST(Path, LiesAsFarFromACentrelineAsConcentricCirclesDo) {
    const Points inner = half_circle(0.10, 2001), outer = half_circle(0.12, 1501);
    const Distances nearest = distances_to_centreline(outer, inner), matched = arc_length_matched(outer, inner);
    EXPECT_NEAR(nearest.mean_m, 0.02, 1e-6);
    EXPECT_NEAR(nearest.largest_m, 0.02, 1e-6);
    EXPECT_NEAR(matched.mean_m, 0.02, 1e-6);
    EXPECT_NEAR(matched.largest_m, 0.02, 1e-6);
    // Above the distance of the curves by no more than the longest step of either.
    EXPECT_GE(frechet_distance_m(outer, inner), 0.02 - 1e-6);
    EXPECT_LE(frechet_distance_m(outer, inner), 0.02 + 0.12 * std::numbers::pi / 1500.0);
}

TEST(Path, TellsTwoWithTheSameNearestDistanceApart) {
    // To and fro once: always on the line, but not where it should be at its share of the way.
    const Points line{{0, 0, 0}, {1, 0, 0}}, to_and_fro{{0, 0, 0}, {0.75, 0, 0}, {0.25, 0, 0}, {1, 0, 0}};
    EXPECT_EQ(distances_to_centreline(to_and_fro, line).largest_m, 0.0);
    // Of the length 2 the share s = 0.375 lies at 0.75, and s = 0.625 at 0.25.
    EXPECT_NEAR(arc_length_matched(to_and_fro, line).largest_m, 0.375, 1e-12);
    EXPECT_GT(frechet_distance_m(to_and_fro, resampled(line, 1001)), 0.2499);
}

// By its definition: the least over all ways, each found by going down every branch.
double frechet_by_branches(const Points& a, const Points& b, std::size_t i, std::size_t k) {
    const double here = glm::distance(a[i], b[k]);
    if (i + 1 == a.size() && k + 1 == b.size()) return here;
    double least = std::numeric_limits<double>::infinity();
    if (i + 1 < a.size()) least = std::min(least, frechet_by_branches(a, b, i + 1, k));
    if (k + 1 < b.size()) least = std::min(least, frechet_by_branches(a, b, i, k + 1));
    if (i + 1 < a.size() && k + 1 < b.size()) least = std::min(least, frechet_by_branches(a, b, i + 1, k + 1));
    return std::max(here, least);
}

TEST(Path, HasTheFrechetDistanceOfTheBestOfAllWays) {
    std::mt19937_64 random(test::property_cases().seed);
    const auto points = [&](std::size_t n) {
        Points list;
        for (std::size_t i = 0; i < n; ++i) {
            list.emplace_back(static_cast<double>(random() % 100), static_cast<double>(random() % 100),
                              static_cast<double>(random() % 100));
        }
        return list;
    };
    for (int i = 0; i < 200; ++i) {
        const Points a = points(1 + random() % 6), b = points(1 + random() % 6);
        EXPECT_EQ(frechet_distance_m(a, b), frechet_by_branches(a, b, 0, 0));
        EXPECT_EQ(frechet_distance_m(a, b), frechet_distance_m(b, a));
    }
}

TEST(Path, IsResampledAtEqualSharesOfItsLength) {
    const Points bent{{0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 1, 0}};
    const Points five = resampled(bent, 5);
    const Points expected{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}};
    ASSERT_EQ(five.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(glm::distance(five[i], expected[i]), 0.0, 1e-12) << i;
}

TEST(Path, IsUndefinedWithoutPointsOrWithOnesThatAreNotFinite) {
    const Points none, still(3, Vec3(1.0)), bad{{0, 0, 0}, {kUndefined, 0, 0}};
    EXPECT_TRUE(std::isnan(path_length_m(none)));
    EXPECT_TRUE(std::isnan(path_length_m(bad)));
    EXPECT_EQ(path_length_m(still), 0.0);
    EXPECT_TRUE(std::isnan(economy_of_path(still)));
    EXPECT_TRUE(std::isnan(economy_of_path(none)));
    for (const auto& [path, line] : {std::pair(none, still), std::pair(still, none), std::pair(bad, still)}) {
        EXPECT_TRUE(std::isnan(distances_to_centreline(path, line).mean_m));
        EXPECT_TRUE(std::isnan(arc_length_matched(path, line).largest_m));
        EXPECT_TRUE(std::isnan(frechet_distance_m(path, line)));
    }
    EXPECT_EQ(arc_length_matched(still, still).largest_m, 0.0);
    EXPECT_TRUE(resampled(none, 5).empty());
}

TEST(TrialMetrics, HaveTheEffectivenessThatTheThesisWorksOut) {
    // 0.0704 and 0.1134 are printed with a total of 18.3844 and an effectiveness of 81.6156: rounded to four digits,
    // the two differ from their sum by up to 1e-4, a hundred times of which is the index.
    EXPECT_NEAR(effectiveness_index(0.0704, 0.1134), 81.6156, 0.0101);
    EXPECT_NEAR(effectiveness_index(0.183844, 0.0), 81.6156, 1e-9);
    EXPECT_EQ(effectiveness_cost(3.0, 0.5, {.of_time = 2.0, .of_deviation = 10.0}), 11.0);
}

std::vector<Nanoseconds> every_ms(std::size_t ticks) {
    std::vector<Nanoseconds> times_ns;
    for (std::size_t i = 0; i < ticks; ++i) times_ns.push_back(5'000'000 + static_cast<Nanoseconds>(i) * 1'000'000);
    return times_ns;
}

TEST(TrialMetrics, AverageTheLengthOfDeviations) {
    const Points points{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}}, walls{{0, 0, 0}, {0.003, 0.004, 0}, {1, 1, 2}};
    EXPECT_NEAR(mean_deviation_m(points, walls), (0.0 + 0.005 + 1.0) / 3.0, 1e-15);
    EXPECT_TRUE(std::isnan(mean_deviation_m({}, {})));
    // By the time that each stands for: 1, 2 and 1 ms.
    const std::vector<double> stand_for = tick_seconds(every_ms(3));
    EXPECT_NEAR(mean_deviation_m(points, walls, stand_for), (0.0 + 2.0 * 0.005 + 1.0) / 4.0, 1e-15);
}

TEST(TrialMetrics, CountContactsByTheTimesOfTheirTicks) {
    const Points forces{{0, 0, 0}, {0, 3, 4}, {1, 0, 0}, {0, 0, 0}, {0, 0, 2}, {0, 0, 0}};
    const ContactFigures figures = contact_figures(forces, every_ms(6));
    EXPECT_EQ(figures.episodes, 1u) << "out of contact for 2 ms";
    EXPECT_DOUBLE_EQ(figures.time_s, 0.003);
    EXPECT_DOUBLE_EQ(figures.peak_force_N, 5.0);
    EXPECT_DOUBLE_EQ(figures.mean_force_N, 8.0 / 3.0);
    EXPECT_EQ(contact_figures(forces, every_ms(6), 1.0).episodes, 1u);
    EXPECT_DOUBLE_EQ(contact_figures(forces, every_ms(6), 1.0).time_s, 0.002);  // 1 N is not more than 1 N
    // The same ticks at other times: each stands for half of the time around it.
    const std::vector<Nanoseconds> uneven{0, 8'000'000, 24'000'000, 28'000'000, 30'000'000, 40'000'000};
    EXPECT_DOUBLE_EQ(contact_figures(forces, uneven).time_s, 0.012 + 0.010 + 0.006);
    EXPECT_DOUBLE_EQ(contact_figures(forces, uneven).mean_force_N, (0.012 * 5 + 0.010 * 1 + 0.006 * 2) / 0.028);
    // Out of contact for 20 ms and for a little more.
    std::vector<Nanoseconds> long_break{0, 1'000'000, 2'000'000, 3'000'000, 22'000'000, 23'000'000};
    EXPECT_EQ(contact_figures(forces, long_break).episodes, 1u);
    long_break[4] += 1;
    EXPECT_EQ(contact_figures(forces, long_break).episodes, 2u);
    EXPECT_EQ(contact_figures({}, {}).episodes, 0u);
    EXPECT_TRUE(std::isnan(contact_figures({}, {}).mean_force_N));
    EXPECT_TRUE(std::isnan(contact_figures(Points{{kUndefined, 0, 0}}, every_ms(1)).peak_force_N));
}

TEST(TrialMetrics, MeasureAWholeTrial) {
    // The top point runs 2 cm outside the centreline against a wall that it is 1 mm deep in, the bottom point on it.
    const std::size_t n = 1001;
    const Points line = half_circle(0.10, n), wall = half_circle(0.119, n), top = half_circle(0.12, n);
    const Points pushed(n, Vec3(0.0, 0.5, 0.0)), free(n, Vec3(0.0));
    const std::vector<Nanoseconds> times_ns = every_ms(n);
    const TrialMetrics metrics = measure_trial(
        {.times_ns = times_ns, .top = {top, wall, pushed}, .bottom = {line, line, free}, .centreline_m = line});
    EXPECT_DOUBLE_EQ(metrics.time_s, 1.0);
    EXPECT_NEAR(metrics.top.deviation_m, 0.001, 1e-12);
    EXPECT_EQ(metrics.bottom.deviation_m, 0.0);
    EXPECT_NEAR(metrics.effectiveness_index, 0.0, 1e-9);  // 100 - 100 (1 mm + 0 mm)
    EXPECT_NEAR(metrics.effectiveness_cost, 2.0, 1e-9);   // 1 s + 1 mm
    // The low-pass cuts corners a little.
    EXPECT_NEAR(metrics.top.economy, 0.10 / 0.12, 0.003);
    EXPECT_NEAR(metrics.bottom.economy, 1.0, 0.003);
    EXPECT_EQ(metrics.bottom.frechet_m, 0.0);
    EXPECT_EQ(metrics.top.contact.episodes, 1u);
    EXPECT_EQ(metrics.bottom.contact.episodes, 0u);
    EXPECT_TRUE(std::isfinite(metrics.top.motion.spectral_arc_length));
    const TrialMetrics nothing = measure_trial({});
    EXPECT_TRUE(std::isnan(nothing.time_s));
    EXPECT_TRUE(std::isnan(nothing.effectiveness_index));
}

}  // namespace
}  // namespace burin::study
