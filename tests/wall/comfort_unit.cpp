// SPDX-License-Identifier: MIT
// Parallax against closed forms and brute force.
#include "wall/comfort.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/wall/wall_samples.hpp"

namespace burin::wall {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kIpd = 0.063;

Eyes facing(const Vec3& at) { return eyes_of({{at, Quat{1, 0, 0, 0}}, kIpd}); }

}  // namespace

TEST(Parallax, EqualsTheClosedFormOfAViewerWhoFacesTheScreen) {
    const Screen wall = screen_of(Wall{});
    for (const double d : {0.6, 1.5, 2.0, 3.0}) {
        for (const double z : {-1000.0, -2.0, -0.1, 0.0, 0.1, 0.3, 0.5}) {
            const Parallax p = parallax_of(wall, facing({0.3, 1.2, d}), {0.3, 1.2, z});
            EXPECT_NEAR(p.m, -kIpd * z / (d - z), 1e-9);
            const double deg = kDegrees * 2.0 * (std::atan(0.5 * kIpd / d) - std::atan(0.5 * kIpd / (d - z)));
            EXPECT_NEAR(p.deg, deg, 1e-9);
            EXPECT_EQ(p.m > 0.0, z < 0.0);
        }
    }
}

TEST(Parallax, IsMeasuredAlongTheEyesHoweverTheHeadIsTilted) {
    const Screen wall = screen_of(Wall{});
    const Eyes eyes = eyes_of({{{0, 1.2, 2.0}, turned(0, 0, 1.1)}, kIpd});
    EXPECT_NEAR(parallax_of(wall, eyes, {0, 1.2, 0.5}).m, -kIpd * 0.5 / 1.5, 1e-9);
    // A head turned by 60 degrees has half the parallax on the wall.
    const Eyes turned_away = eyes_of({{{0, 1.2, 2.0}, turned(std::numbers::pi / 3, 0, 0)}, kIpd});
    EXPECT_NEAR(parallax_of(wall, turned_away, {0, 1.2, -2.0}).m, 0.5 * 0.5 * kIpd, 1e-4);
}

// Figures derived from the definition: at 2 m a degree crossed reaches 0.71 m in front, 1.84 degrees 1.01 m; behind the
// screen 1.80 degrees suffice for infinity.
TEST(ComfortRange, GivesTheDistancesAtWhichTheBudgetIsUsedUp) {
    const Screen wall = screen_of(Wall{});
    EXPECT_NEAR(2.0 - comfort_range({1.0, 1.0}, kIpd, 2.0).nearest_m, 0.71, 0.005);
    EXPECT_NEAR(2.0 - comfort_range({1.84, 2.04}, kIpd, 2.0).nearest_m, 1.01, 0.005);
    EXPECT_FALSE(comfort_range({1.84, 2.04}, kIpd, 2.0).farthest_m);
    for (const double d : {0.5, 1.0, 2.0}) {
        const ParallaxBudget budget{1.2, 0.9};
        const ComfortRange range = comfort_range(budget, kIpd, d);
        const Eyes eyes = facing({0, 1, d});
        EXPECT_NEAR(parallax_of(wall, eyes, {0, 1, d - range.nearest_m}).deg, -1.2, 1e-9);
        ASSERT_TRUE(range.farthest_m);
        EXPECT_NEAR(parallax_of(wall, eyes, {0, 1, d - *range.farthest_m}).deg, 0.9, 1e-9);
        const BudgetOnScreen on_screen = budget_on_screen(budget, kIpd, d);
        EXPECT_NEAR(on_screen.crossed_m, -parallax_of(wall, eyes, {0, 1, d - range.nearest_m}).m, 1e-9);
        EXPECT_NEAR(on_screen.uncrossed_m, parallax_of(wall, eyes, {0, 1, d - *range.farthest_m}).m, 1e-9);
    }
}

TEST(ComfortRange, NeverLetsTheEyesDiverge) {
    for (const double d : {0.3, 1.0, 2.0, 10.0}) {
        EXPECT_LE(budget_on_screen({1.84, 2.04}, kIpd, d).uncrossed_m, kIpd);
        EXPECT_LE(budget_on_screen({20.0, 20.0}, kIpd, d).uncrossed_m, kIpd);
    }
    EXPECT_EQ(budget_on_screen({1.84, 2.04}, kIpd, 10.0).uncrossed_m, kIpd);
}

// Against four thousand points of each ball and box.
TEST(LargestParallax, EqualsASearchOverAllPointsOfTheContent) {
    const Screen wall = screen_of(Wall{});
    std::mt19937 random(4);
    std::uniform_real_distribution<double> share(-1.0, 1.0), radius(0.02, 0.5);
    for (int trial = 0; trial < 60; ++trial) {
        const Eyes eyes = facing({share(random), 1.2 + 0.4 * share(random), 2.0 + share(random)});
        const Vec3 eye = eyes.left_world;
        const Vec3 center{1.4 * share(random), 1.1 + share(random), eye.z - 1.0 + 0.4 * share(random) - 1.0};
        const bool ball = trial % 2 == 0;
        const Vec3 half{0.8 * radius(random), 0.8 * radius(random), 0.8 * radius(random)};
        const ContentBall b{center, half.x};
        const Box box{center - half, center + half};
        Content content;
        if (ball) content.balls = {&b, 1};
        if (!ball) content.boxes_world = {&box, 1};
        double crossed = 0.0, uncrossed = 0.0;
        for (int i = 0; i < 4000; ++i) {
            Vec3 at = random_vector(random, 1.0);
            if (ball) {
                at = center + half.x * glm::normalize(at);
            } else {
                at[i % 3] = at[i % 3] < 0.0 ? -1.0 : 1.0;
                at = center + half * at;
            }
            const double deg = parallax_of(wall, eyes, at).deg;
            crossed = std::min(crossed, deg), uncrossed = std::max(uncrossed, deg);
        }
        const ContentParallax found = largest_parallax(wall, eyes, content);
        EXPECT_LE(found.crossed.deg, crossed * 0.95 + 1e-6);
        EXPECT_GE(found.crossed.deg, crossed * 1.05 - 0.01);
        EXPECT_GE(found.uncrossed.deg, uncrossed * 0.95 - 1e-6);
        EXPECT_LE(found.uncrossed.deg, uncrossed * 1.05 + 0.01);
    }
}

TEST(ComfortWarning, SaysHowFarToMoveTheSceneAndThatSuffices) {
    const Screen wall = screen_of(Wall{});
    const Eyes eyes = facing({0, 1.2, 2.0});
    const ParallaxBudget budget;
    ContentBall ball{{0, 1.2, 1.2}, 0.1};  // its front 1.3 m before the wall, 0.29 m beyond the limit of 1.01
    const ComfortFinding finding = judge(budget, wall, eyes, {{&ball, 1}, {}});
    EXPECT_TRUE(finding.crossed_too_much);
    EXPECT_FALSE(finding.uncrossed_too_much);
    EXPECT_NEAR(finding.parallax.in_front_m, 1.3, 1e-9);
    ASSERT_TRUE(finding.move_m);
    EXPECT_NEAR(*finding.move_m, -(comfort_range(budget, kIpd, 2.0).nearest_m - 0.7), 2e-4);
    const std::string text = warning_of(finding, budget);
    EXPECT_NE(text.find("move the scene 0.30 m back"), std::string::npos) << text;
    EXPECT_NE(text.find("117 mm"), std::string::npos) << text;  // 63 * 1.3 / 0.7
    ball.center_world.z -= 0.30;
    EXPECT_TRUE(warning_of(judge(budget, wall, eyes, {{&ball, 1}, {}}), budget).empty());
}

TEST(ComfortWarning, KnowsDepthThatNoMoveMends) {
    const Screen desk{{-0.26, 0, 0}, {0.26, 0, 0}, {-0.26, 0.3, 0}};
    const Eyes eyes = facing({0, 0.15, 0.6});
    const Box deep{{-0.1, 0.1, -3.0}, {0.1, 0.2, 0.4}};
    const ComfortFinding both = judge({}, desk, eyes, {{}, {&deep, 1}});
    EXPECT_TRUE(both.crossed_too_much && both.uncrossed_too_much);
    EXPECT_FALSE(both.move_m);
    EXPECT_NE(warning_of(both, {}).find("scale the scene down"), std::string::npos);
    const Box far{{-0.1, 0.1, -1.0}, {0.1, 0.2, -0.9}};
    const ComfortFinding behind = judge({}, desk, eyes, {{}, {&far, 1}});
    EXPECT_TRUE(behind.uncrossed_too_much);
    ASSERT_TRUE(behind.move_m);
    EXPECT_NE(warning_of(behind, {}).find("forward"), std::string::npos);
    EXPECT_TRUE(warning_of(judge({}, desk, eyes, {}), {}).empty());
}

TEST(ComfortWarning, IsGivenWherePicturesLieFartherApartThanTheEyesThoughTheBudgetAllowsIt) {
    // A head turned by 60 degrees sees what is far off under 126 mm of parallax, twice the distance of its eyes; one
    // that faces the screen never more than that distance.
    const Screen wall = screen_of(Wall{});
    const ParallaxBudget generous{20.0, 20.0};
    const Eyes turned_away = eyes_of({{{0, 1.2, 2.0}, turned(std::numbers::pi / 3, 0, 0)}, kIpd});
    const Vec3 ahead{-std::sin(std::numbers::pi / 3), 0.0, -std::cos(std::numbers::pi / 3)};
    const ContentBall far_ahead{Vec3{0, 1.2, 2.0} + 1e4 * ahead, 0.1}, far_behind{{0, 1.2, -1e4}, 0.1};
    const ComfortFinding finding = judge(generous, wall, turned_away, {{&far_ahead, 1}, {}});
    EXPECT_LT(finding.parallax.uncrossed.deg, 2.0);
    EXPECT_NEAR(finding.parallax.uncrossed.m, 2.0 * kIpd, 0.01 * kIpd);
    EXPECT_TRUE(finding.uncrossed_too_much);
    EXPECT_NE(warning_of(finding, generous).find("126 mm"), std::string::npos) << warning_of(finding, generous);
    const ComfortFinding straight = judge(generous, wall, facing({0, 1.2, 2.0}), {{&far_behind, 1}, {}});
    EXPECT_NEAR(straight.parallax.uncrossed.m, kIpd, 0.01 * kIpd);
    EXPECT_FALSE(straight.uncrossed_too_much);
}

}  // namespace burin::wall
