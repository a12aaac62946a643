// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "app/felt_stroke.hpp"
#include "app/report.hpp"

namespace burin {

TEST(Sweeps, AStraightRunBecomesOneSweep) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 10; ++i) points.emplace_back(i * 0.001, 0.0, 0.0);
    const auto sweeps = sweeps_along(points, {0.01, 3}, 1e-6);
    ASSERT_EQ(sweeps.size(), 1u);
    EXPECT_EQ(sweeps[0].start_object_m, points.front());
    EXPECT_EQ(sweeps[0].end_object_m, points.back());
    EXPECT_EQ(sweeps[0].material, 3);
}

TEST(Sweeps, AnArcStaysWithinToleranceAndKeepsItsEnds) {
    constexpr double kTolerance = 1e-3;
    std::vector<Vec3> points;
    for (int i = 0; i <= 90; ++i) points.emplace_back(std::cos(i * M_PI / 180), std::sin(i * M_PI / 180), 0.0);
    const auto sweeps = sweeps_along(points, {0.1, 0}, kTolerance);
    EXPECT_EQ(sweeps.size(), 18u);  // a chord of angle a lies a^2 / 8 from the arc: five of the one-degree steps each
    EXPECT_EQ(sweeps.front().start_object_m, points.front());
    EXPECT_EQ(sweeps.back().end_object_m, points.back());
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        if (i > 0) {
            EXPECT_EQ(sweeps[i].start_object_m, sweeps[i - 1].end_object_m);
        }
        const Vec3 middle = 0.5 * (sweeps[i].start_object_m + sweeps[i].end_object_m);
        EXPECT_GT(glm::length(middle), 1.0 - 1.01 * kTolerance);
    }
}

TEST(Sweeps, APointIsAStampAndNothingIsNothing) {
    const std::vector<Vec3> point{Vec3(1, 2, 3)};
    ASSERT_EQ(sweeps_along(point, {0.1, 0}, 1.0).size(), 1u);
    EXPECT_TRUE(sweeps_along({}, {0.1, 0}, 1.0).empty());
}

TEST(Quantile, IsTheNearestRank) {
    EXPECT_EQ(quantile({}, 0.5), 0.0);
    EXPECT_EQ(quantile({3.0}, 0.999), 3.0);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 0.5), 2.0);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 0.0), 1.0);
}

}  // namespace burin
