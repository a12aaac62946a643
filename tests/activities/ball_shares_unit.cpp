// SPDX-License-Identifier: MIT
// What each finger gives of a squeeze: a target asks for a share of each, or says that it is reached together.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/ball/ball.hpp"
#include "activities/rehab/exercise_kinds.hpp"

namespace burin::activities {
namespace {

// A ball whose fingers press for a time, a turn each millisecond.
class SharedBall {
public:
    explicit SharedBall(const SettingValues& values) : ball_(values) {}
    void press(double for_s, const FingerForces& forces_N) {
        for (int i = 0; i < static_cast<int>(for_s * 1000.0 + 0.5); ++i) {
            ExerciseTurn turn{now_ns_, true, {}};
            turn.fingers.dt_s = 0.001;
            turn.fingers.forces_N = forces_N;
            ball_.turn(turn, orders_);
            now_ns_ += 1'000'000;
        }
    }
    [[nodiscard]] ExerciseCourse course() const { return ball_.course(); }
    [[nodiscard]] const std::vector<std::string>& messages() const { return orders_.messages; }
    [[nodiscard]] std::string task() const { return ball_.task(); }

private:
    Ball ball_;
    session::ActivityOrders orders_;
    Nanoseconds now_ns_ = 5'000'000'000;
};

SettingValues values_with(double share) {
    SettingValues values(Ball::setting_kinds());
    values.set("share", share);
    return values;
}

}  // namespace

TEST(BallShares, AFingerThatGivesNothingKeepsASqueezeFromCounting) {
    for (std::size_t idle = 0; idle < devices::kGloveFingers; ++idle) {
        FingerForces forces_N{1.0, 1.0, 1.0, 1.0};
        forces_N[idle] = 0.0;  // the others reach 2 N without it
        SharedBall ball(values_with(0.1));
        ball.press(3.0, forces_N);
        EXPECT_EQ(ball.course().counts[0].number, 0u) << idle;
        EXPECT_EQ(ball.course().score, 0.0) << idle;
        const auto tells = [&](const std::string& text) { return text.contains("and 0.20 N is asked of each finger"); };
        EXPECT_EQ(std::ranges::count_if(ball.messages(), tells), 1) << "once a squeeze";
        EXPECT_TRUE(ball.messages().back().contains("the " + std::string(kFingerNames[idle]) + " presses with 0.00 N"))
            << ball.messages().back();
        forces_N[idle] = 0.19;
        ball.press(1.2, forces_N);
        EXPECT_EQ(ball.course().counts[0].number, 0u) << idle;
        forces_N[idle] = 0.21;
        ball.press(1.2, forces_N);
        EXPECT_EQ(ball.course().counts[0].number, 1u) << idle;
    }
}

TEST(BallShares, AFingerThatLeavesEndsAHoldThoughTheSumStays) {
    SharedBall ball(values_with(0.1));
    ball.press(0.5, {1.0, 1.0, 1.0, 0.5});
    ball.press(0.3, {1.0, 1.0, 1.0, 0.17});  // within 80 %
    EXPECT_EQ(ball.course().counts[1].number, 0u);
    ball.press(0.3, {1.0, 1.0, 1.0, 0.0});
    EXPECT_EQ(ball.course().counts[1].number, 1u) << "held too short";
}

TEST(BallShares, TogetherIsSaidAndTakesWhoeverGivesIt) {
    SharedBall ball(values_with(0.0));
    EXPECT_EQ(ball.task(), "Squeeze the ball with 2 N in all fingers together for 1.0 s, then relax.");
    ball.press(1.2, {2.1, 0.0, 0.0, 0.0});
    EXPECT_EQ(ball.course().counts[0].number, 1u);
    EXPECT_TRUE(SharedBall(values_with(0.25)).task().contains("0.5 N or more in each")) << "a quarter";
}

// Recordings that were made before keep what they meant.
TEST(BallShares, ALineWithoutAShareIsReachedTogether) {
    const auto old = exercise_of("rehab ball --colour green --level 2 --repetitions 7 --hold 0.5 --time-limit 33.5");
    ASSERT_TRUE(old);
    EXPECT_EQ((*old)->settings().number("share"), 0.0);
    const SettingValues fresh(Ball::setting_kinds());
    EXPECT_GT(fresh.number("share"), 0.0) << "an exercise of today asks for all fingers";
    EXPECT_FALSE(
        exercise_of("rehab ball --colour green --level 2 --repetitions 7 --hold 0.5 --time-limit 33.5 "
                    "--share 0.3"));
    EXPECT_FALSE(
        exercise_of("rehab ball --colour green --level 2 --repetitions 7 --hold 0.5 --time-limit 33.5 "
                    "--share"));
}

}  // namespace burin::activities
