// SPDX-License-Identifier: MIT
// A force that adapts to a chosen rate of success: its steps, where it comes to rest, what the ball makes of it, and
// from where the next run goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "activities/rehab/ball/ball.hpp"
#include "activities/rehab/ball/ball_exercise.hpp"
#include "activities/rehab/progress/progress.hpp"

namespace burin::activities {
namespace {

constexpr double kSqueezeTurn_s = 0.001;

// A person who goes on squeezing with the same force of each finger: for 0.4 s, then rests for 0.4 s.
struct Squeezed {
    BallSettings settings;
    BallState state = {};
    Nanoseconds now_ns = 1'000'000'000;

    void press(double each_N, double for_s) {
        for (double at_s = 0.0; at_s < for_s - 1e-9; at_s += kSqueezeTurn_s) {
            ExerciseTurn turn;
            turn.time_ns = now_ns += 1'000'000;
            turn.grasped = true;
            turn.fingers.dt_s = kSqueezeTurn_s;
            turn.fingers.forces_N.fill(each_N);
            state = step_ball(std::move(state), settings, turn).state;
        }
    }
    void squeeze(double each_N) {
        press(each_N, 0.6);
        press(0.0, 0.5);
    }
};

BallSettings adapting(double rate, double target_N) {
    BallSettings settings{.repetitions = 1000, .hold_s = 0.2, .time_limit_s = 3600.0, .share = 0.0};
    settings.adapts = Staircase{target_N, 0.1, 20.0, rate};
    return settings;
}

KeptRun kept(const std::string& date, const std::string& ended, double time_limit_s, double next_target_N) {
    return {7,
            date,
            "10:15:00",
            "glove:4",
            {{"exercise", "ball"},
             {"settings", {{"level", 1.0}, {"time_limit_s", time_limit_s}}},
             {"ended", ended},
             {"score", 95.0},
             {"time_s", 30.0},
             {"counts", Json::object()},
             {"ball", {{"next_target_N", next_target_N}}},
             {"fingers", Json::array()}}};
}

}  // namespace

TEST(Staircases, GoDownByAsMuchAsTheRateTakesOfStepsUp) {
    const Staircase at{4.0, 0.5, 8.0, 0.75};
    EXPECT_DOUBLE_EQ(after_trial(at, true).target_N, 4.0 * 1.05);
    EXPECT_DOUBLE_EQ(after_trial(at, false).target_N, 4.0 / std::pow(1.05, 3.0)) << "0.75 / 0.25";
    Staircase after = at;
    for (const bool succeeded : {true, true, true, false}) after = after_trial(after, succeeded);
    EXPECT_NEAR(after.target_N, 4.0, 1e-12) << "three of four";
    EXPECT_EQ(after_trial({7.9, 0.5, 8.0, 0.75}, true).target_N, 8.0);
    EXPECT_EQ(after_trial({0.5, 0.5, 8.0, 0.75}, false).target_N, 0.5);
}

// Pressed with more than half of what is asked, and interrupted: no success and no failure.
TEST(Staircases, StayWhereABreakHasInterruptedASqueeze) {
    Squeezed person{adapting(0.75, 4.0)};
    person.press(0.75, 0.3);
    ASSERT_TRUE(person.state.tried);
    person.state = interrupted(std::move(person.state), person.now_ns).state;
    person.press(0.0, 0.5);
    EXPECT_EQ(person.state.too_weak, 0u);
    EXPECT_EQ(target_N_of(person.state, person.settings), 4.0);
    person.squeeze(0.75);
    EXPECT_EQ(person.state.too_weak, 1u) << "the same without a break";
    EXPECT_DOUBLE_EQ(target_N_of(person.state, person.settings), 4.0 / std::pow(1.05, 3.0));
    const double begun_N = target_N_of(person.state, person.settings);
    person.press(2.0, 0.1);
    ASSERT_EQ(person.state.phase, BallPhase::holds);
    person.state = interrupted(std::move(person.state), person.now_ns).state;
    person.press(0.0, 0.5);
    EXPECT_EQ(person.state.too_short, 0u);
    EXPECT_EQ(target_N_of(person.state, person.settings), begun_N);
}

// A person who succeeds with a share that falls with the target, 1 / (1 + (t / 4 N)^6): the formula tells where that
// is the rate.
TEST(Staircases, ComeToRestWhereTheRateIsTheChosenOne) {
    for (const double rate : {0.5, 0.75, 0.9}) {
        std::mt19937_64 random(15);
        Staircase staircase{2.0, 0.1, 20.0, rate};
        double succeeded = 0.0, logs = 0.0;
        constexpr int kSkipped = 200, kTrials = 20'000;
        for (int i = 0; i < kSkipped + kTrials; ++i) {
            const double chance = 1.0 / (1.0 + std::pow(staircase.target_N / 4.0, 6.0));
            const bool success = static_cast<double>(random() >> 11) * 0x1p-53 < chance;
            if (i >= kSkipped) {
                succeeded += success ? 1.0 : 0.0;
                logs += std::log(staircase.target_N);
            }
            staircase = after_trial(staircase, success);
        }
        EXPECT_NEAR(succeeded / kTrials, rate, 0.005) << "as steps cancel";
        const double rests_N = 4.0 * std::pow(1.0 / rate - 1.0, 1.0 / 6.0);
        // It goes about by steps: on average no farther off than by half a step down, or by one up.
        const double half_step = 0.5 * rate / (1.0 - rate) * std::log(Staircase::kUp);
        EXPECT_NEAR(logs / kTrials, std::log(rests_N), std::max(half_step, std::log(Staircase::kUp))) << rate;
    }
}

TEST(AdaptingBall, AsksForMoreAfterASqueezeThatCountsAndForLessAfterOneThatDoesNot) {
    Squeezed person{adapting(0.75, 2.0)};
    person.squeeze(1.0);  // 4 N together
    EXPECT_EQ(person.state.repetitions, 1u);
    EXPECT_DOUBLE_EQ(target_N_of(person.state, person.settings), 2.0 * 1.05);
    person.squeeze(0.4);  // 1.6 N: more than half of it, and not enough
    EXPECT_EQ(person.state.too_weak, 1u);
    EXPECT_DOUBLE_EQ(target_N_of(person.state, person.settings), 2.1 / std::pow(1.05, 3.0));
    person.squeeze(0.1);  // no try at all
    EXPECT_EQ(person.state.too_weak, 1u);
    person.press(1.0, 0.1);  // held too short: one failure, though it is half pressed on
    person.press(0.3, 0.3);
    person.press(0.0, 0.5);
    EXPECT_EQ(person.state.too_short, 1u);
    EXPECT_EQ(person.state.too_weak, 1u);
    EXPECT_DOUBLE_EQ(target_N_of(person.state, person.settings), 2.1 / std::pow(1.05, 6.0));
}

// Somebody who always presses with 3 N together: three of four squeezes count at the end, since the target goes up past
// it by threes.
TEST(AdaptingBall, IsHeldAtTheChosenRateByAPersonOfOneForce) {
    Squeezed person{adapting(0.75, 1.0)};
    for (int i = 0; i < 60; ++i) person.squeeze(0.75);
    const unsigned before = person.state.repetitions, weak = person.state.too_weak;
    for (int i = 0; i < 40; ++i) person.squeeze(0.75);
    EXPECT_NEAR(person.state.repetitions - before, 30.0, 1.0);
    EXPECT_NEAR(person.state.too_weak - weak, 10.0, 1.0);
    EXPECT_NEAR(target_N_of(person.state, person.settings), 3.0, 3.0 * 0.16);
}

TEST(AdaptingBall, IsAsBeforeWhereItDoesNotAdapt) {
    Squeezed plain{{.repetitions = 1000, .hold_s = 0.2, .time_limit_s = 3600.0, .share = 0.0}};
    for (const double each_N : {1.0, 0.4, 1.0}) plain.squeeze(each_N);
    EXPECT_EQ(plain.state.repetitions, 2u);
    EXPECT_EQ(plain.state.too_weak, 0u);
    EXPECT_EQ(target_N_of(plain.state, plain.settings), 2.0);
    SettingValues values(Ball::setting_kinds());
    EXPECT_FALSE(ball_settings(values).adapts);
    values.set("success", 0.3);
    EXPECT_TRUE(Ball::conflict(values));
    values.set("success", 0.75);
    EXPECT_FALSE(Ball::conflict(values));
    values.set("begin_N", 3.0);
    EXPECT_EQ(ball_settings(values).adapts->target_N, 3.0);
    values.set("success", 0.0);
    EXPECT_TRUE(Ball::conflict(values));
}

TEST(AdaptingBall, GoesOnWhereTheLastRunEndedWhateverEndedItAndWhateverItsLimit) {
    const std::vector<KeptRun> runs{kept("2026-11-01", "done", 60.0, 2.4), kept("2026-11-02", "broken off", 90.0, 2.9)};
    EXPECT_EQ(adapted_target_N(runs, 7, "ball"), 2.9);
    EXPECT_FALSE(adapted_target_N(runs, 8, "ball"));
    EXPECT_FALSE(adapted_target_N(runs, 7, "putty"));
    // And a proposal is of runs of other limits as well.
    const KeptRun a = kept("2026-11-01", "done", 60.0, 2.0), b = kept("2026-11-02", "broken off", 10.0, 2.0),
                  c = kept("2026-11-03", "done", 90.0, 2.0), d = kept("2026-11-04", "time over", 45.0, 2.0);
    const std::vector<const KeptRun*> all{&a, &b, &c, &d};
    EXPECT_EQ(proposed(all, 3).level, 2u) << proposed(all, 3).reason;
}

}  // namespace burin::activities
