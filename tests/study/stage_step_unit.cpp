// SPDX-License-Identifier: MIT
// The pure step of a stage: which movements count, and when exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "study/trial/stage_step.hpp"

namespace burin::study {
namespace {

// A straight tube along x from 0 to 0.4 m.
const StudyWorld kStraight{"straight", {{0.0, 0.0, 0.0}, {0.2, 0.0, 0.0}, {0.4, 0.0, 0.0}}, 0.045, 0.06, 0.02, 0.0};

StageSetup trial_setup(ClockStart clock = ClockStart::leave, unsigned attempts = 3) {
    StageSetup setup;
    setup.kind = StageKind::trial;
    setup.ends_at_exit = true;
    setup.attempts = attempts;
    setup.clock = clock;
    setup.start = start_cap(kStraight);
    setup.end = end_cap(kStraight);
    setup.spine_m = kStraight.spine_m;
    return setup;
}

struct Ran {
    StageState state;
    std::vector<StageEvent> events;
};

// Ticks until the stage is done; the wand's middle is where `middle_m` says, its top so far from it and its bottom on
// the other side: upright, unless `up` says otherwise.
Ran run_stage(const StageSetup& setup, double until_s, double tick_s, const std::function<Vec3(double)>& middle_m,
              const std::function<void(StageTick&)>& change = {}, const Vec3& up = {0.0, 0.03, 0.0}) {
    Ran ran;
    for (int i = 0; i * tick_s <= until_s; ++i) {
        const Vec3 m = middle_m(i * tick_s);
        StageTick tick{i * tick_s, {m + up, m - up}, OperatorAct::none, false};
        if (change) change(tick);
        const StageStep stepped = step(setup, ran.state, tick);
        ran.state = stepped.state;
        for (std::size_t e = 0; e < stepped.event_count; ++e) ran.events.push_back(stepped.events[e]);
    }
    return ran;
}

std::vector<Failure> failures_of(const Ran& ran) {
    std::vector<Failure> found;
    for (const StageEvent& e : ran.events) {
        if (e.kind == StageEventKind::attempt_failed) found.push_back(e.failure);
    }
    return found;
}

Vec3 straight_on(double t, double speed = 0.1) { return {-0.01 + speed * t, 0.0, 0.0}; }

TEST(StageStep, TimesATrialFromCapToCapExactlyBetweenTicks) {
    // At 0.1 m/s 0.4 m take 4 s, whatever the ticks are.
    for (const double tick_s : {0.001, 0.0073, 0.03, 0.04}) {
        const Ran ran = run_stage(trial_setup(), 5.0, tick_s, [](double t) { return straight_on(t); });
        EXPECT_EQ(ran.state.result, StageResult::valid_exit) << tick_s;
        EXPECT_NEAR(trial_time_s(ran.state), 4.0, 1e-9) << tick_s;
        EXPECT_NEAR(ran.state.clock_started_s, 0.1, 1e-9);
        EXPECT_NEAR(ran.state.clock_stopped_s, 4.1, 1e-9);
    }
}

// A tilted wand: one point leads by up to 10 mm. The clock starts when the other has left the cap as well, and stops
// when the other has come into the end cap as well, whichever of the two it is.
TEST(StageStep, ClockGoesByTheLaterOfTheTwoPoints) {
    for (const double lead_m : {0.005, -0.005, 0.0005, -0.0005}) {
        for (const double tick_s : {0.001, 0.0073, 0.03, 0.04}) {
            const Ran ran =
                run_stage(trial_setup(), 5.0, tick_s, [](double t) { return straight_on(t); }, {}, {lead_m, 0.03, 0.0});
            ASSERT_EQ(ran.state.result, StageResult::valid_exit) << lead_m << " " << tick_s;
            const double later_s = 0.1 + std::abs(lead_m) / 0.1;
            EXPECT_NEAR(ran.state.clock_started_s, later_s, 1e-9) << lead_m << " " << tick_s;
            EXPECT_NEAR(ran.state.clock_stopped_s, later_s + 4.0, 1e-9) << lead_m << " " << tick_s;
        }
    }
}

TEST(StageStep, SeesAWandThatCrossesTheWholeTubeWithinATick) {
    StageSetup setup = trial_setup();
    // From x = -0.01 to 0.59 in one tick of 0.04 s: face at 0 after 1/60, end at 0.4 after 41/60 of it.
    const Ran ran = run_stage(setup, 0.2, 0.04, [](double t) { return Vec3{t < 0.1 ? -0.01 : 0.59, 0.0, 0.0}; });
    EXPECT_EQ(ran.state.result, StageResult::valid_exit);
    EXPECT_NEAR(trial_time_s(ran.state), 0.04 * 40.0 / 60.0, 1e-12);
}

TEST(StageStep, ClockThatStartsAtTheTouchCountsTheRestInTheCap) {
    const auto rests = [](double t) { return straight_on(std::max(0.0, t - 1.0)); };
    const Ran ran = run_stage(trial_setup(ClockStart::touch), 7.0, 0.001, rests);
    EXPECT_EQ(ran.state.result, StageResult::valid_exit);
    EXPECT_NEAR(trial_time_s(ran.state), 5.1, 1e-9);
}

TEST(StageStep, DoesNotStartWithOnePointInTheCap) {
    // Half the wand is above the cap.
    const Ran ran = run_stage(trial_setup(), 5.0, 0.001, [](double t) { return straight_on(t) + Vec3{0, 0.05, 0}; });
    EXPECT_EQ(ran.state.phase, StagePhase::waiting);
    EXPECT_TRUE(ran.events.empty());
}

TEST(StageStep, FailsAnAttemptThatGoesAroundTheTubeAndLetsItBeRepeated) {
    const auto once_around = [](double t) {
        if (t < 2.0) return straight_on(t) + Vec3{0.0, t > 1.0 ? 0.5 * (t - 1.0) : 0.0, 0.0};
        return straight_on(t - 2.0);
    };
    const Ran ran = run_stage(trial_setup(), 7.0, 0.001, once_around);
    EXPECT_EQ(failures_of(ran), std::vector{Failure::strayed});
    EXPECT_EQ(ran.state.result, StageResult::valid_exit);
    EXPECT_EQ(ran.state.attempt, 2u);
    EXPECT_NEAR(trial_time_s(ran.state), 4.0, 1e-9);
}

TEST(StageStep, FailsAnEndCapThatIsTouchedFromBehind) {
    // Beside the tube, past the cap at its side, and back onto it.
    const auto from_behind = [](double t) {
        if (t < 1.0) return straight_on(t);
        if (t < 2.0) return straight_on(1.0) + Vec3{0.0, 0.0, 0.12 * (t - 1.0)};
        if (t < 6.0) return Vec3{0.09 + 0.1 * (t - 2.0), 0.0, 0.12};
        return Vec3{0.49, 0.0, 0.12} + (t - 6.0) * Vec3{-0.1, 0.0, -0.12};
    };
    const Ran ran = run_stage(trial_setup(ClockStart::leave, 1), 8.0, 0.001, from_behind);
    EXPECT_EQ(failures_of(ran), std::vector{Failure::wrong_exit});
    EXPECT_EQ(ran.state.result, StageResult::no_attempt_left);
}

TEST(StageStep, FailsAWayBackThroughTheStart) {
    const auto back = [](double t) { return Vec3{-0.01 + 0.1 * (t < 2.0 ? t : std::max(0.0, 4.0 - t)), 0.0, 0.0}; };
    const Ran ran = run_stage(trial_setup(ClockStart::leave, 1), 5.0, 0.001, back);
    EXPECT_EQ(failures_of(ran), std::vector{Failure::went_back});
}

TEST(StageStep, AHandThatTremblesAtTheStartIsNoReturn) {
    const auto trembles = [](double t) { return straight_on(t) + Vec3{0.008 * std::sin(40.0 * t), 0.0, 0.0}; };
    const Ran ran = run_stage(trial_setup(), 5.0, 0.001, trembles);
    EXPECT_TRUE(failures_of(ran).empty());
    EXPECT_EQ(ran.state.result, StageResult::valid_exit);
}

TEST(StageStep, FailsAWandThatWasLaidDown) {
    const auto laid = [](double t) { return straight_on(std::min(t, 2.0)); };
    const Ran ran = run_stage(trial_setup(ClockStart::leave, 1), 13.0, 0.001, laid);
    EXPECT_EQ(failures_of(ran), std::vector{Failure::laid_down});
}

TEST(StageStep, AmplifiersThatTripSpoilTheAttemptButUseNoneUp) {
    const auto twice = [](double t) { return straight_on(t < 3.0 ? t : t - 3.0); };
    const auto trips = [](StageTick& tick) { tick.amplifiers_off = tick.time_s > 2.0 && tick.time_s < 2.1; };
    const Ran ran = run_stage(trial_setup(ClockStart::leave, 1), 8.0, 0.001, twice, trips);
    EXPECT_EQ(failures_of(ran), std::vector{Failure::amplifiers});
    EXPECT_EQ(ran.state.result, StageResult::valid_exit);
    EXPECT_NEAR(trial_time_s(ran.state), 4.0, 1e-9);
}

TEST(StageStep, AGapInTheTicksSpoilsTheAttempt) {
    const auto silent = [](StageTick& tick) {
        if (tick.time_s > 2.0 && tick.time_s < 2.2) tick.points_m[0].x = std::nan("");
    };
    const Ran ran = run_stage(trial_setup(), 5.0, 0.001, [](double t) { return straight_on(t); }, silent);
    EXPECT_EQ(failures_of(ran), std::vector{Failure::gap});
    EXPECT_NE(ran.state.result, StageResult::valid_exit);
}

// Every way to fail, with one attempt and with three: which of them uses an attempt up.
TEST(StageStep, OnlyFailuresOfThePersonUseUpAnAttempt) {
    const auto goes = [](double t) { return straight_on(t); };
    const auto strays = [](double t) { return straight_on(t) + Vec3{0.0, t > 1.0 ? 0.5 * (t - 1.0) : 0.0, 0.0}; };
    const auto goes_back = [](double t) { return straight_on(t < 2.0 ? t : std::max(0.0, 4.0 - t)); };
    const auto lies = [](double t) { return straight_on(std::min(t, 2.0)); };
    const auto from_behind = [](double t) {
        if (t < 1.0) return straight_on(t);
        if (t < 2.0) return straight_on(1.0) + Vec3{0.0, 0.0, 0.12 * (t - 1.0)};
        if (t < 6.0) return Vec3{0.09 + 0.1 * (t - 2.0), 0.0, 0.12};
        return Vec3{0.49, 0.0, 0.12} + (t - 6.0) * Vec3{-0.1, 0.0, -0.12};
    };
    const auto at_two = [](auto&& what) {
        return [what](StageTick& tick) {
            if (std::abs(tick.time_s - 2.0) < 1e-9) what(tick);
        };
    };
    struct Way {
        Failure failure;
        std::function<Vec3(double)> middle_m;
        std::function<void(StageTick&)> change;
        bool of_person;
    };
    const std::vector<Way> ways{
        {Failure::strayed, strays, {}, true},
        {Failure::wrong_exit, from_behind, {}, true},
        {Failure::went_back, goes_back, {}, true},
        {Failure::laid_down, lies, {}, true},
        {Failure::amplifiers, goes, at_two([](StageTick& tick) { tick.amplifiers_off = true; }), false},
        {Failure::gap, goes,
         [](StageTick& tick) {
             if (tick.time_s > 2.0 && tick.time_s < 2.1) tick.points_m[0].x = std::nan("");
         },
         false},
        {Failure::paused, goes, at_two([](StageTick& tick) { tick.act = OperatorAct::pause; }), false},
        {Failure::repeated, goes, at_two([](StageTick& tick) { tick.act = OperatorAct::repeat; }), false}};
    for (const Way& way : ways) {
        const std::string name = name_of(way.failure);
        const Ran three = run_stage(trial_setup(ClockStart::leave, 3), 13.0, 0.001, way.middle_m, way.change);
        ASSERT_EQ(failures_of(three), std::vector{way.failure}) << name;
        EXPECT_EQ(three.state.attempt, way.of_person ? 2u : 1u) << name;
        EXPECT_NE(three.state.result, StageResult::no_attempt_left) << name;
        const Ran one = run_stage(trial_setup(ClockStart::leave, 1), 13.0, 0.001, way.middle_m, way.change);
        EXPECT_EQ(one.state.result == StageResult::no_attempt_left, way.of_person) << name;
        EXPECT_EQ(one.state.attempt, 1u) << name;
    }
}

TEST(StageStep, TheTimeOfAPauseIsNotTheStagesTime) {
    StageSetup setup;
    setup.kind = StageKind::free_training;
    setup.ends_after_s = 2.0;
    const auto acts = [](StageTick& tick) {
        if (std::abs(tick.time_s - 1.0) < 1e-9) tick.act = OperatorAct::pause;
        if (std::abs(tick.time_s - 4.0) < 1e-9) tick.act = OperatorAct::go_on;
    };
    const Ran ran = run_stage(setup, 6.0, 0.25, [](double) { return Vec3{0.0}; }, acts);
    ASSERT_EQ(ran.state.result, StageResult::time_over);
    EXPECT_NEAR(ran.events.back().time_s, 5.0, 1e-12);
}

TEST(StageStep, OperatorEndsOnlyWhatTheProtocolLetsHimEnd) {
    StageSetup page;
    const auto next = [](StageTick& tick) { tick.act = OperatorAct::next; };
    EXPECT_EQ(run_stage(page, 1.0, 0.1, [](double) { return Vec3{0.0}; }, next).state.result, StageResult::open);
    page.ends_by_operator = true;
    EXPECT_EQ(run_stage(page, 1.0, 0.1, [](double) { return Vec3{0.0}; }, next).state.result, StageResult::by_operator);
}

TEST(StageStep, KeepsItsHeadOnTimesAndPlacesThatAreNone) {
    StageSetup setup = trial_setup();
    StageState state;
    for (const double time_s : {0.0, std::nan(""), -1.0, 0.001, HUGE_VAL, 0.002}) {
        const Vec3 bad{time_s == 0.001 ? std::nan("") : -0.01, 0.0, 0.0};
        state = step(setup, state, {time_s, {bad, bad}, OperatorAct::none, false}).state;
    }
    EXPECT_NE(state.phase, StagePhase::done);
    EXPECT_TRUE(std::isfinite(state.time_s));
}

}  // namespace
}  // namespace burin::study
