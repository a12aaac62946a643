// SPDX-License-Identifier: MIT
// Start, pause, rest and stop: the clock stands still and no force is given, nothing is measured meanwhile, and what
// was under way counts for nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "activities/rehab/ball/ball_exercise.hpp"
#include "activities/rehab/exercise/run_control.hpp"
#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/game/game_exercise.hpp"
#include "activities/rehab/putty/putty_exercise.hpp"
#include "activities/rehab/rehab.hpp"
#include "tests/activities/acted_hand.hpp"

namespace burin::activities {
namespace {

constexpr Nanoseconds kTurn_ns = 1'000'000;

// A control that is led for a time, a turn each millisecond.
struct Led {
    RunControl control;
    Nanoseconds now_ns = 3'000'000'000;
    void go_on(double for_s, bool let_go = true) {
        for (int i = 0; i < static_cast<int>(1000.0 * for_s + 0.5); ++i)
            control = with_turn(control, now_ns += kTurn_ns, let_go);
    }
    std::string tell(RunOrder order) {
        const Result<RunControl> next = with_order(control, order);
        if (next) control = *next;
        return next ? "" : next.error().line();
    }
};

// A ball of 2 N, grasped by a hand on which each finger presses alike; a turn each millisecond.
class PausedBall {
public:
    explicit PausedBall(const char* start) : rehab_(made(start)) { step(1); }
    session::ActivityOrders step(int turns) { return hand_.go_on(rehab_, turns); }
    void press(double of_each_N) {
        for (std::size_t finger = 0; finger < kFelt; ++finger) {
            if (of_each_N > 0.0) hand_.touch(finger, kBallOfHand, {0.0, 1.0, 0.0});
            hand_.push(finger, of_each_N);
        }
    }
    Result<void> tell(const char* act) {
        session::ActivityOrders orders;
        Result<void> done = rehab_.act(std::vector<std::string>{act}, orders);
        parameters = orders.parameters;
        return done;
    }
    [[nodiscard]] bool gives_force() const {
        haptics::TickParameters parameters_of_tick;
        rehab_.adjust({0, 0}, parameters_of_tick);
        return !parameters_of_tick.holds;
    }
    [[nodiscard]] Json report() const { return rehab_.report(); }
    [[nodiscard]] const Rehab& rehab() const { return rehab_; }
    bool parameters = false;

private:
    static constexpr scene::ObjectId kBallOfHand = 2;  // the exercise's body takes the place of the world's second
    static std::unique_ptr<Exercise> made(const char* start) {
        const ExerciseKind& kind = *exercise_named("ball");
        SettingValues values(kind.settings);
        EXPECT_TRUE(values.set("start", start));
        return kind.make(values);
    }
    ActedHand hand_;
    Rehab rehab_;
};

ExerciseTurn turn_at(Nanoseconds time_ns, double of_each_N) {
    ExerciseTurn turn{time_ns, true, {}};
    turn.fingers.dt_s = 0.001;
    turn.fingers.forces_N.fill(of_each_N);
    return turn;
}

}  // namespace

TEST(RunControl, HasTheClockStandStillForAsLongAsABreakLasts) {
    Led led;
    led.go_on(1.0);
    EXPECT_EQ(led.control.away_ns, 0);
    EXPECT_EQ(led.tell(RunOrder::pause), "");
    led.go_on(2.5);
    EXPECT_FALSE(led.control.gives_force());
    EXPECT_EQ(led.tell(RunOrder::rest), "");
    led.go_on(4.0);
    EXPECT_EQ(led.control.away_ns, 6'500'000'000);
    EXPECT_NEAR(led.control.paused_s, 2.5, 1e-9);
    EXPECT_NEAR(led.control.rested_s, 4.0, 1e-9);
    EXPECT_EQ(led.control.exercise_ns(led.now_ns), 4'000'000'000);
    EXPECT_EQ(led.tell(RunOrder::start), "");
    EXPECT_TRUE(led.control.gives_force());
    led.go_on(5.0, false);
    EXPECT_FALSE(led.control.runs()) << "the fingers press still";
    led.go_on(0.001);
    EXPECT_TRUE(led.control.runs());
    EXPECT_EQ(led.control.away_ns, 11'501'000'000);
}

// A force that fades in from zero is no sign that a finger has let go.
TEST(RunControl, DoesNotTakeAForceThatFadesInForFingersThatHaveLetGo) {
    Led led;
    led.go_on(0.1);
    ASSERT_EQ(led.tell(RunOrder::pause), "");
    ASSERT_EQ(led.tell(RunOrder::start), "");
    led.go_on(0.298);
    EXPECT_FALSE(led.control.runs());
    led.go_on(0.003);
    EXPECT_TRUE(led.control.runs());
}

TEST(RunControl, RefusesOrdersThatHaveNoSenseAndSaysWhatHas) {
    Led led;
    EXPECT_EQ(led.tell(RunOrder::start), "do start: is of no use: it is under way; do pause, rest or stop");
    led.control.phase = RunPhase::ready;
    EXPECT_EQ(led.tell(RunOrder::pause), "do pause: comes too early; begin with do start");
    EXPECT_EQ(led.tell(RunOrder::start), "");
    EXPECT_TRUE(led.control.runs()) << "nothing was pressed before";
    EXPECT_EQ(led.tell(RunOrder::pause), "");
    EXPECT_EQ(led.tell(RunOrder::pause), "do pause: is of no use: it is so already; do start to go on");
    EXPECT_EQ(led.tell(RunOrder::stop), "");
    for (const RunOrder order : {RunOrder::start, RunOrder::pause, RunOrder::rest, RunOrder::stop})
        EXPECT_TRUE(led.tell(order).contains("it has been stopped"));
}

TEST(RunControl, OfABallDropsTheSqueezeUnderWayWithoutAFault) {
    const BallSettings settings{.level = 1, .repetitions = 2, .hold_s = 1.0, .share = 0.0};
    BallState state;
    Nanoseconds now_ns = 1'000'000'000;
    const auto squeeze = [&](int turns) {
        for (int i = 0; i < turns; ++i) state = step_ball(state, settings, turn_at(now_ns += kTurn_ns, 1.0)).state;
    };
    squeeze(700);
    ASSERT_EQ(state.phase, BallPhase::holds);
    const BallStep broken = interrupted(state, now_ns);
    ASSERT_EQ(broken.events.size(), 1u);
    EXPECT_EQ(broken.events[0].what, ball_event::kInterrupted);
    state = broken.state;
    EXPECT_EQ(state.phase, BallPhase::waits);
    squeeze(900);
    EXPECT_EQ(state.repetitions, 0u) << "the ring begins anew";
    squeeze(300);
    EXPECT_EQ(state.repetitions, 1u);
    EXPECT_EQ(state.too_short, 0u);
    EXPECT_DOUBLE_EQ(score_of(state, settings), 50.0);
}

TEST(RunControl, OfPuttyDropsTheKneadUnderWayWithoutAFault) {
    const PuttySettings settings{.shape = PuttyShape::ellipsoid, .level = 1};  // 3 N
    PuttyState state;
    Nanoseconds now_ns = 1'000'000'000;
    for (int i = 0; i < 100; ++i) state = step_putty(state, settings, turn_at(now_ns += kTurn_ns, 0.5)).state;
    ASSERT_EQ(state.phase, PuttyPhase::presses);
    state = interrupted(state, now_ns).state;
    for (int i = 0; i < 100; ++i) state = step_putty(state, settings, turn_at(now_ns += kTurn_ns, 0.0)).state;
    EXPECT_EQ(state.too_weak + state.wrong_grip, 0u);
}

// A throw that was interrupted in flight is none: it is neither thrown nor missed, and the ball waits at its place.
TEST(RunControl, OfTheGameTakesBackAThrowThatIsInTheAir) {
    GameState state;
    state.phase = GamePhase::flies;
    state.throws = 3;
    state.catches = 1;
    state.misses = 1;
    state.begun_ns = 1;
    const GameStep broken = interrupted(state, 5'000'000'000);
    EXPECT_EQ(broken.state.throws, 2u);
    EXPECT_EQ(broken.state.misses, 1u);
    ASSERT_EQ(broken.events.size(), 1u);
    const GameSettings settings;
    const GameRoom room;
    ExerciseTurn turn{5'001'000'000, false, {}};
    const GameState next = step_game(broken.state, settings, room, turn).state;
    EXPECT_EQ(next.phase, GamePhase::waits);
    EXPECT_EQ(next.ball.place_m, room.serve_m);
    EXPECT_EQ(next.misses, 1u);
}

TEST(RehabRun, OfAnAssessmentHasNoBodyNorTimeLimitAndWaitsForStartAsTheOthersDo) {
    const ExerciseKind& kind = *exercise_named("assess");
    SettingValues values(kind.settings);
    ASSERT_TRUE(values.set("start", "asked"));
    Rehab rehab(kind.make(values));
    rehab.fitted_by({{"text", "an assessment of before"}});
    ActedHand hand;
    hand.go_on(rehab, 100);
    const Json report = rehab.report();
    EXPECT_TRUE(report.at("young_Pa").is_null() && report.at("held_N_per_m").is_null());
    EXPECT_EQ(report.at("pauses"), 0);
    EXPECT_EQ(report.at("fitted_by").at("text"), "an assessment of before");
    EXPECT_TRUE(report.at("assess").at("fingers").is_array());
    EXPECT_EQ(report.at("time_s"), 0.0);
    const session::ActivityPanel panel = rehab.panel();
    EXPECT_EQ(panel.task->progress, "1 of 9");
    const auto has_fitted = [](const auto& row) { return row.front() == "fitted by"; };
    EXPECT_TRUE(std::ranges::any_of(panel.tables.front().rows, has_fitted));
    session::ActivityOrders orders;
    ASSERT_TRUE(rehab.act(std::vector<std::string>{"start"}, orders));
    hand.go_on(rehab, 1001);
    EXPECT_NEAR(rehab.report().at("time_s").get<double>(), 1.0, 1e-9);
}

TEST(RehabRun, WaitsForStartAndGivesNoForceBefore) {
    PausedBall ball("asked");
    ball.press(1.0);
    ball.step(500);
    EXPECT_FALSE(ball.gives_force());
    EXPECT_TRUE(ball.report().at("events").empty()) << "the clock has not begun";
    EXPECT_EQ(ball.report().at("fingers").at(1).at("peak_force_N"), 0.0);
    ASSERT_TRUE(ball.tell("start"));
    EXPECT_TRUE(ball.parameters && ball.gives_force());
    ball.press(0.0);
    ball.step(1000);
    EXPECT_NEAR(ball.report().at("time_s").get<double>(), 0.999, 1e-9) << "from the first turn after Start";
}

TEST(RehabRun, MeasuresNothingInABreakAndItsClockStandsStill) {
    PausedBall ball("at_once");
    ball.step(999);
    const double before_s = ball.report().at("time_s").get<double>();
    for (const char* order : {"pause", "rest"}) {
        ASSERT_TRUE(ball.tell(order)) << order;
        EXPECT_TRUE(ball.parameters && !ball.gives_force()) << order;
        ball.press(3.0);
        ball.step(400);
        EXPECT_EQ(ball.report().at("time_s").get<double>(), before_s) << order;
        EXPECT_EQ(ball.report().at("fingers").at(1).at("peak_force_N"), 0.0) << order;
    }
    ASSERT_TRUE(ball.tell("start"));
    ball.step(1000);
    EXPECT_EQ(ball.report().at("fingers").at(1).at("peak_force_N"), 0.0) << "what is pressed still is none of it";
    ball.press(0.0);
    ball.step(1);
    ball.step(100);
    const Json report = ball.report();
    EXPECT_NEAR(report.at("time_s").get<double>() - before_s, 0.1, 1e-9) << "it goes on where it stood still";
    EXPECT_EQ(report.at("pauses"), 1);
    EXPECT_EQ(report.at("rests"), 1);
    EXPECT_NEAR(report.at("paused_s").get<double>(), 0.4, 1e-9);
    EXPECT_NEAR(report.at("rested_s").get<double>(), 0.4, 1e-9);
    ball.press(1.5);
    ball.step(50);
    EXPECT_EQ(ball.report().at("fingers").at(1).at("peak_force_N"), 1.5);
}

TEST(RehabRun, ThatIsStoppedIsBrokenOffAndGivesNoForceAnyMore) {
    PausedBall ball("at_once");
    ball.step(100);
    ASSERT_TRUE(ball.tell("stop"));
    ball.press(2.0);
    ball.step(500);
    EXPECT_FALSE(ball.gives_force());
    EXPECT_EQ(ball.report().at("ended"), "broken off");
    EXPECT_EQ(ball.report().at("broken_off_because"), "it was stopped");
    EXPECT_EQ(ball.report().at("fingers").at(1).at("peak_force_N"), 0.0);
    EXPECT_FALSE(ball.tell("start"));
}

// Of a recording of before there were these orders the number that each frame keeps stays what it was.
TEST(RehabRun, ChangesTheReplaysNumberOnlyOnceItWasTold) {
    PausedBall ball("at_once"), other("at_once");
    ball.step(50);
    other.step(50);
    EXPECT_EQ(ball.rehab().check(), other.rehab().check());
    ASSERT_TRUE(ball.tell("pause"));
    ball.step(50);
    EXPECT_NE(ball.rehab().check(), other.rehab().check());
}

TEST(RehabRun, ShowsForcesAgainstWhatIsAskedAndWhatComesNext) {
    PausedBall ball("asked");
    session::ActivityPanel panel = ball.rehab().panel();
    ASSERT_TRUE(panel.task.has_value());
    EXPECT_EQ(panel.task->state, "Ready: the time begins with Start");
    EXPECT_TRUE(panel.hides_scene);
    EXPECT_FALSE(panel.help.empty());
    ASSERT_EQ(panel.task->bars.size(), 5u) << "four fingers and all together";
    EXPECT_EQ(panel.task->bars[1].name, "index");
    EXPECT_DOUBLE_EQ(panel.task->bars[1].target_N, 0.2) << "a tenth of 2 N";
    EXPECT_DOUBLE_EQ(panel.task->bars[4].target_N, 2.0);
    EXPECT_FALSE(panel.task->bars[1].given_N) << "it measures nothing";
    ASSERT_TRUE(ball.tell("start"));
    ball.step(2);
    ball.press(0.7);
    ball.step(1000);
    panel = ball.rehab().panel();
    EXPECT_NEAR(panel.task->bars[1].asked_N, 0.7, 0.021) << "drawn in steps of 0.02 N";
    EXPECT_NEAR(panel.task->bars[4].asked_N, 2.8, 0.021);
    EXPECT_TRUE(panel.task->state.empty());
    EXPECT_EQ(panel.task->progress, "0 of 5");
    const auto enabled = [&](const char* title) {
        for (const auto& button : panel.buttons())
            if (button.title == title) return button.enabled;
        return false;
    };
    EXPECT_TRUE(!enabled("Start") && enabled("Pause") && enabled("Rest") && enabled("Stop"));
}

}  // namespace burin::activities
