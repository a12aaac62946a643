// SPDX-License-Identifier: MIT
// Screens found again from noisy touches.
#include "wall/calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/wall/wall_samples.hpp"

namespace burin::wall {
namespace {

struct Truth {
    Vec3 corner, right, up;
    double width_m, height_m;

    explicit Truth(std::mt19937& random) {
        std::uniform_real_distribution<double> size(0.4, 4.0);
        const Quat q = random_rotation(random);
        corner = random_vector(random, 3.0);
        right = q * Vec3{1, 0, 0};
        up = q * Vec3{0, 1, 0};
        width_m = size(random), height_m = size(random);
    }
    [[nodiscard]] Vec3 at(double u, double v) const { return corner + u * width_m * right + v * height_m * up; }
};

Vec3 noise(std::mt19937& random, double sigma_m) {
    std::normal_distribution<double> value(0.0, sigma_m);
    const double x = value(random), y = value(random), z = value(random);
    return {x, y, z};
}

const std::array<std::pair<const char*, Vec2>, 4> kCorners{
    {{"lower_left", {0, 0}}, {"lower_right", {1, 0}}, {"upper_left", {0, 1}}, {"upper_right", {1, 1}}}};

std::vector<CalibrationSample> touched(const Truth& truth, std::mt19937& random, int each, double sigma_m) {
    std::vector<CalibrationSample> samples;
    for (const auto& [name, uv] : kCorners) {
        for (int i = 0; i < each; ++i) samples.push_back({name, truth.at(uv.x, uv.y) + noise(random, sigma_m)});
    }
    return samples;
}

double corner_error(const ScreenFit& fit, const Truth& truth) {
    return std::max({glm::length(fit.lower_left_tracker - truth.at(0, 0)),
                     glm::length(fit.lower_right_tracker - truth.at(1, 0)),
                     glm::length(fit.upper_left_tracker - truth.at(0, 1))});
}

}  // namespace

// Four corners, five touches each, 1 mm of noise: 60 numbers and 8 unknowns leave a mean square of (60 - 8) / 20 mm^2.
TEST(Calibration, LeavesTheResidualThatTheoryExpectsOnTenThousandWalls) {
    std::mt19937 random(1);
    constexpr double kSigma_m = 1e-3;
    constexpr int kWalls = 10000;
    double sum_mm2 = 0.0, worst_m = 0.0, sum_error2 = 0.0;
    std::size_t outliers = 0;
    for (int i = 0; i < kWalls; ++i) {
        const Truth truth(random);
        const auto fit = fit_screen(touched(truth, random, 5, kSigma_m));
        ASSERT_TRUE(fit) << fit.error().line();
        sum_mm2 += fit->rms_mm * fit->rms_mm;
        outliers += fit->outliers.size();
        const double error_m = corner_error(*fit, truth);
        worst_m = std::max(worst_m, error_m);
        sum_error2 += error_m * error_m;
        EXPECT_LT(std::abs(glm::dot(fit->lower_right_tracker - fit->lower_left_tracker,
                                    fit->upper_left_tracker - fit->lower_left_tracker)),
                  1e-12 * 16.0);
    }
    const double expected_mm2 = (60.0 - 8.0) / 20.0;
    // The mean of 10^4 sums of 52 squares: standard deviation expected * sqrt(2 / 52) / 100.
    EXPECT_NEAR(sum_mm2 / kWalls, expected_mm2, 5.0 * expected_mm2 * std::sqrt(2.0 / 52.0) / 100.0);
    EXPECT_LT(outliers, 300u);  // of 2e5 samples: the deviation is estimated from 60 numbers
    EXPECT_LT(worst_m, 0.005);
    EXPECT_LT(std::sqrt(sum_error2 / kWalls), 0.0015);
}

TEST(Calibration, IsExactWithoutNoise) {
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        const Truth truth(random);
        const auto fit = fit_screen(touched(truth, random, 1, 0.0));
        ASSERT_TRUE(fit);
        EXPECT_LT(corner_error(*fit, truth), 1e-9);
        EXPECT_NEAR(fit->width_m, truth.width_m, 1e-9);
        EXPECT_NEAR(fit->height_m, truth.height_m, 1e-9);
        EXPECT_LT(fit->max_mm, 1e-6);
    }
}

// No rectangle nearby fits better: the fit is a least one, not only a small one.
TEST(Calibration, FindsTheLeastSquares) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const Truth truth(random);
        const auto samples = touched(truth, random, 3, 2e-3);
        const auto fit = fit_screen(samples);
        ASSERT_TRUE(fit) << fit.error().line();
        if (!fit->outliers.empty()) continue;
        for (int k = 0; k < 20; ++k) {
            const Quat q = glm::normalize(Quat{1.0, 1e-4 * random_vector(random, 1.0)});
            const Vec3 shift = random_vector(random, 2e-4);
            const double grow = 1.0 + 1e-4 * random_vector(random, 1.0).x;
            const auto moved = [&](const Vec3& p) { return q * (p - truth.corner) * grow + truth.corner + shift; };
            WallScreen s;
            s.lower_left_tracker = moved(fit->lower_left_tracker);
            s.lower_right_tracker = moved(fit->lower_right_tracker);
            s.upper_left_tracker = moved(fit->upper_left_tracker);
            EXPECT_GE(distances_from(s, samples)->rms_mm, fit->rms_mm - 1e-9);
        }
    }
}

TEST(Calibration, NamesOutliersAndIsNotMovedByThem) {
    std::mt19937 random(4);
    for (int i = 0; i < 200; ++i) {
        const Truth truth(random);
        auto samples = touched(truth, random, 5, 5e-4);
        const std::size_t wrong = static_cast<std::size_t>(i) % samples.size();
        samples[wrong].tip_tracker += 0.1 * glm::normalize(random_vector(random, 1.0));
        const auto fit = fit_screen(samples);
        ASSERT_TRUE(fit) << fit.error().line();
        ASSERT_GE(fit->outliers.size(), 1u);
        EXPECT_TRUE(std::ranges::any_of(fit->outliers, [&](const SampleOutlier& o) {
            return o.index == wrong && o.place == samples[wrong].place && std::abs(o.distance_mm - 100.0) < 5.0;
        }));
        EXPECT_LT(corner_error(*fit, truth), 0.003);
        EXPECT_LT(fit->max_mm, 5.0);
    }
}

TEST(Calibration, UsesEdgesGridPointsAndAKnownSize) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 100; ++i) {
        const Truth truth(random);
        // Three touches in the middle of the picture fix the plane; edges the rest.
        std::vector<CalibrationSample> samples;
        for (const char* grid : {"0.25:0.25", "0.75:0.25", "0.5:0.75"}) {
            const auto place = screen_place(grid);
            samples.push_back({grid, truth.at(*place->u, *place->v)});
        }
        for (int k = 0; k < 5; ++k) {
            samples.push_back({"left", truth.at(0.0, share(random))});
            samples.push_back({"top", truth.at(share(random), 1.0)});
            samples.push_back({"right", truth.at(1.0, share(random))});
            samples.push_back({"bottom", truth.at(share(random), 0.0)});
        }
        auto fit = fit_screen(samples);
        ASSERT_TRUE(fit) << fit.error().line();
        EXPECT_LT(corner_error(*fit, truth), 1e-8);
        for (CalibrationSample& s : samples) s.tip_tracker += noise(random, 5e-4);
        fit = fit_screen(samples);
        ASSERT_TRUE(fit) << fit.error().line();
        EXPECT_LT(corner_error(*fit, truth), 0.006);
        const auto known = fit_screen(samples, ScreenSize{truth.width_m, truth.height_m});
        ASSERT_TRUE(known) << known.error().line();
        EXPECT_EQ(known->width_m, truth.width_m);
        EXPECT_LT(corner_error(*known, truth), 0.006);
    }
}

TEST(Calibration, RefusesWhatDoesNotFixTheScreen) {
    const auto refused = [](std::vector<CalibrationSample> samples, const std::string& part) {
        const auto fit = fit_screen(samples);
        ASSERT_FALSE(fit) << part;
        EXPECT_NE(fit.error().line().find(part), std::string::npos) << fit.error().line();
        EXPECT_FALSE(fit.error().remedy.empty());
    };
    const CalibrationSample ll{"lower_left", {0, 0, 0}}, lr{"lower_right", {2, 0, 0}}, ul{"upper_left", {0, 1, 0}};
    EXPECT_TRUE(fit_screen(std::vector{ll, lr, ul}));
    refused({}, "three corners");
    refused({ll, lr}, "three corners");
    refused({ll, {"upper_right", {2, 1, 0}}, {"0.5:0.5", {1, 0.5, 0}}}, "three corners");
    refused({ll, lr, {"upper_left", {1, 0, 0}}}, "three corners");
    refused({ll, ll, ll}, "three corners");
    refused({ll, lr, {"upper_left", {0, std::nan(""), 0}}}, "sample 3 (upper_left)");
    refused({ll, lr, {"middle", {0, 1, 0}}}, "sample 3 (middle)");
    refused({ll, lr, {"0.5:1.5", {0, 1, 0}}}, "names no place");
    refused({ll, {"lower_right", {0.002, 0, 0}}, {"upper_left", {0, 0.001, 0}}}, "0.002");
    refused({ll, {"lower_right", {2000, 0, 0}}, {"upper_left", {0, 1500, 0}}}, "unit");
    // A corner whose touches are far apart from one another and from the rest.
    std::mt19937 random(6);
    const Truth truth(random);
    auto samples = touched(truth, random, 5, 5e-4);
    for (int i = 0; i < 4; ++i) samples[static_cast<std::size_t>(i)].tip_tracker += random_vector(random, 0.5);
    refused(samples, "lower_left");
}

// Of two touches that contradict each other nobody knows which is right.
TEST(Calibration, RefusesAPlaceOfWhichOnlyHalfTheSamplesFit) {
    std::mt19937 random(7);
    for (int i = 0; i < 100; ++i) {
        const Truth truth(random);
        auto samples = touched(truth, random, 4, 2e-4);
        const std::size_t corner = 4 * (static_cast<std::size_t>(i) % 4);
        const Vec3 aside = 0.1 * glm::normalize(random_vector(random, 1.0));
        const auto one_wrong = [&] {
            auto with = samples;
            with[corner + 1].tip_tracker += aside;
            return with;
        }();
        const auto fit = fit_screen(one_wrong);
        ASSERT_TRUE(fit) << fit.error().line();
        auto half_wrong = one_wrong;
        half_wrong[corner + 3].tip_tracker -= aside;  // to the other side, so that the medians stay where they were
        const auto refused = fit_screen(half_wrong);
        ASSERT_FALSE(refused) << i;
        EXPECT_NE(refused.error().line().find(samples[corner].place), std::string::npos) << refused.error().line();
        EXPECT_NE(refused.error().line().find("2 of its 4 samples"), std::string::npos) << refused.error().line();
    }
}

}  // namespace burin::wall
