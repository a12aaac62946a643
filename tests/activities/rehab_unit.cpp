// SPDX-License-Identifier: MIT
// The ball exercise: its rules turn by turn, its settings' file, its scripted participant.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "activities/rehab/ball/ball.hpp"
#include "activities/rehab/ball/scripted_squeezes.hpp"
#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/rehab.hpp"
#include "scene/vrml_world.hpp"

namespace burin::activities {
namespace {

namespace What = ball_event;

// An exercise that is given a force for a time, a turn each millisecond.
class Exercised {
public:
    explicit Exercised(const BallSettings& settings) : settings_(settings) {}
    void squeeze(double seconds_s, double force_N, bool grasped = true) {
        const auto turns = static_cast<int>(seconds_s * 1000.0 + 0.5);
        for (int i = 0; i < turns; ++i) {
            ExerciseTurn turn{now_ns_, grasped, {}};
            turn.fingers.dt_s = 0.001;
            turn.fingers.forces_N = {0.4 * force_N, 0.3 * force_N, 0.2 * force_N, 0.1 * force_N};
            turn.fingers.joints_rad[2] = {0.0, 0.1 * force_N, 0.0, -0.2 * force_N};
            measures_ = with_turn(measures_, turn.fingers);
            BallStep step = step_ball(state_, settings_, turn);
            state_ = step.state;
            events_.insert(events_.end(), step.events.begin(), step.events.end());
            now_ns_ += 1'000'000;
        }
    }
    void rest(double seconds_s) { squeeze(seconds_s, 0.0, false); }
    [[nodiscard]] const HandMeasures& measures() const { return measures_; }
    [[nodiscard]] const BallState& state() const { return state_; }
    [[nodiscard]] std::vector<std::string_view> events() const {
        std::vector<std::string_view> all;
        for (const ExerciseEvent& event : events_) all.push_back(event.what);
        return all;
    }
    [[nodiscard]] const ExerciseEvent& event(std::size_t index) const { return events_.at(index); }

private:
    BallSettings settings_;
    BallState state_;
    HandMeasures measures_;
    std::vector<ExerciseEvent> events_;
    Nanoseconds now_ns_ = 5'000'000'000;
};

std::string all_lines(const ReadSettings& read) {
    std::string text;
    for (const Error& error : read.errors) text += error.line() + "\n";
    return text;
}

}  // namespace

TEST(BallExercise, CountsASqueezeThatIsHeldAndRelaxed) {
    Exercised ball({.level = 2, .repetitions = 2, .hold_s = 1.0});  // 4 N
    ball.rest(0.5);
    ball.squeeze(0.2, 3.9);
    ball.squeeze(1.2, 4.1);
    EXPECT_EQ(ball.state().repetitions, 1u);
    ball.squeeze(2.0, 4.1);
    EXPECT_EQ(ball.state().repetitions, 1u) << "one squeeze counts once, however long it lasts";
    ball.squeeze(0.2, 1.9);
    ball.squeeze(1.2, 5.0);
    EXPECT_EQ(ball.state().repetitions, 1u) << "that was no rest";
    ball.squeeze(0.5, 1.9);
    ball.squeeze(1.2, 5.0);
    EXPECT_EQ(ball.state().repetitions, 2u);
    EXPECT_EQ(ball.state().end, ExerciseEnd::done);
    EXPECT_EQ(ball.events(), (std::vector{What::kBegun, What::kGrasped, What::kReached, What::kCounted, What::kReached,
                                          What::kCounted, What::kDone}));
    EXPECT_EQ(ball.event(3).time_ns - ball.event(2).time_ns, 1'000'000'000);
    EXPECT_DOUBLE_EQ(score_of(ball.state(), {.repetitions = 2}), 100.0);
}

TEST(BallExercise, BeginsTheTimeAnewWhereTheForceSinks) {
    Exercised ball({.level = 1, .repetitions = 4, .hold_s = 1.0});  // 2 N
    ball.squeeze(0.9, 2.1);
    ball.squeeze(0.05, 1.61);  // within 80 %: it still holds
    EXPECT_EQ(ball.state().too_short, 0u);
    ball.squeeze(0.1, 1.59);
    EXPECT_EQ(ball.state().too_short, 1u);
    ball.squeeze(0.9, 2.1);
    EXPECT_EQ(ball.state().repetitions, 0u);
    ball.squeeze(0.2, 2.1);
    EXPECT_EQ(ball.state().repetitions, 1u);
    EXPECT_DOUBLE_EQ(score_of(ball.state(), {.repetitions = 4}), 22.5);
}

// A stiff ball pushes fingers that leave it by fits: 5 ms of twice the target, 5 ms of nothing, less and less.
TEST(BallExercise, TakesFitsOfAHandThatLetsGoForNoSqueezes) {
    Exercised ball({.level = 1, .repetitions = 3, .hold_s = 0.5});  // 2 N
    ball.squeeze(0.8, 3.0);
    EXPECT_EQ(ball.state().repetitions, 1u);
    for (int i = 0; i < 20; ++i) {
        ball.squeeze(0.005, 4.0 * (1.0 - i / 20.0));
        ball.squeeze(0.005, 0.0);
    }
    ball.rest(0.5);
    EXPECT_EQ(ball.state().too_short, 0u);
    ball.squeeze(0.8, 3.0);
    EXPECT_EQ(ball.state().repetitions, 2u);
}

TEST(BallExercise, TakesNoForceOfAHandThatGraspsNothing) {
    Exercised ball({.hold_s = 0.1});
    ball.squeeze(1.0, 9.0, false);
    EXPECT_EQ(ball.state().repetitions, 0u);
    ball.squeeze(0.05, 9.0);
    ball.squeeze(0.01, 9.0, false);
    EXPECT_EQ(ball.state().too_short, 1u) << "letting go ends a hold";
}

TEST(BallExercise, EndsWithItsTimeAndStaysAsItIsThen) {
    Exercised ball({.time_limit_s = 0.5});
    ball.squeeze(0.6, 9.0);
    EXPECT_EQ(ball.state().end, ExerciseEnd::time_over);
    EXPECT_NEAR(ball.state().time_s(), 0.5, 1e-9);
    const BallState then = ball.state();
    ball.squeeze(5.0, 9.0);
    EXPECT_EQ(ball.state(), then);
}

TEST(HandMeasures, AreOfEachFingersForceAndTheRangeOfEachJoint) {
    Exercised ball({});
    ball.squeeze(0.5, 2.0);
    ball.squeeze(0.5, 6.0);
    ball.rest(1.0);
    const FingerMeasures &thumb = ball.measures().fingers[0], &middle = ball.measures().fingers[2];
    EXPECT_NEAR(thumb.peak_N, 2.4, 1e-12);
    EXPECT_NEAR(thumb.mean_N(), 1.6, 1e-9) << "over the time in which it was pushed";
    EXPECT_NEAR(thumb.pushed_s, 1.0, 1e-9);
    EXPECT_NEAR(middle.range_rad(1), 0.6, 1e-12);
    EXPECT_NEAR(middle.range_rad(3), 1.2, 1e-12);
    EXPECT_EQ(thumb.range_rad(1), 0.0);
}

// A thumb that bends by 1 rad in 0.5 s while the index follows with a fifth of that, then the index alone.
TEST(HandMeasures, AreOfHowFastAFingerGoesAndHowStillTheOthersStay) {
    HandMeasures measures;
    FingersTurn turn;
    turn.dt_s = 0.001;
    const auto go = [&](int turns, double thumb_rad, double index_rad) {
        for (int i = 0; i < turns; ++i) {
            for (std::size_t joint = 1; joint < devices::kFingerJoints; ++joint) {
                turn.joints_rad[0][joint] += thumb_rad / (3.0 * turns);
                turn.joints_rad[1][joint] += index_rad / (3.0 * turns);
            }
            measures = with_turn(measures, turn);
        }
    };
    go(1, 0.0, 0.0);
    go(500, 1.0, 0.2);
    go(1000, 0.0, 0.0);
    go(250, 0.0, 1.0);
    const FingerMeasures &thumb = measures.fingers[0], &index = measures.fingers[1];
    EXPECT_NEAR(thumb.peak_rad_per_s, 2.0, 1e-9);
    EXPECT_NEAR(thumb.mean_rad_per_s(), 2.0, 1e-9) << "of when it moved";
    EXPECT_NEAR(index.peak_rad_per_s, 4.0, 1e-9);
    EXPECT_NEAR(*thumb.fractionation(), 1.0 - 0.2 / 3.0, 1e-9);
    EXPECT_NEAR(*index.fractionation(), 1.0, 1e-9);
    EXPECT_FALSE(measures.fingers[2].fractionation()) << "it never led";
}

TEST(RehabSettings, AreReadAndWrittenAlike) {
    const ExerciseKind& kind = *exercise_named("ball");
    SettingValues values(kind.settings);
    ASSERT_TRUE(values.set("colour", "blue"));
    for (const auto& [key, value] :
         {std::pair{"level", 3.0}, {"repetitions", 12.0}, {"hold_s", 0.75}, {"time_limit_s", 90.0}})
        values.set(key, value);
    const ReadSettings read = read_settings(table_text("ball", values), "s.toml", kind);
    EXPECT_TRUE(read.errors.empty()) << all_lines(read);
    EXPECT_EQ(read.values, values);
    EXPECT_EQ(ball_settings(read.values), (BallSettings{BallColour::blue, 3, 12, 0.75, 90.0, 0.1}));
    EXPECT_EQ(ball_settings(read_settings("", "s.toml", kind).values), BallSettings{}) << "every key has a default";
}

TEST(RehabSettings, TellEachMistakeWithItsLine) {
    const ExerciseKind& kind = *exercise_named("ball");
    const ReadSettings read = read_settings(
        "[ball]\ncolor = \"red\"\ncolour = \"purple\"\nlevel = 4\nrepetitions = 2.5\nhold_s = -1\ntime_limit_s = 0\n"
        "[bal]\n",
        "s.toml", kind);
    const std::string text = all_lines(read);
    for (const char* line : {"s.toml:2: [ball] has no key named color; did you mean colour?",
                             "s.toml:3: colour is purple; there are yellow, red, green, blue", "s.toml:4: level is 4",
                             "s.toml:5: repetitions is 2.5", "s.toml:6: hold_s is -1", "s.toml:7: time_limit_s is 0",
                             "s.toml:8: the file has no key named bal; did you mean ball?"})
        EXPECT_TRUE(text.contains(line)) << line << " is missing in\n" << text;
    EXPECT_EQ(read.errors.size(), 7u) << text;
    for (const char* wrong :
         {"[ball]\nlevel = 1e99", "[ball]\ntime_limit_s = nan", "ball = 3", "[ball", "[ball]\nlevel = -1"})
        EXPECT_FALSE(read_settings(wrong, "s.toml", kind).errors.empty()) << wrong;
}

TEST(RehabSettings, SayWhichNumbersAKeyTakes) {
    const ReadSettings read = read_settings("[ball]\nlevel = \"two\"\n", "s.toml", *exercise_named("ball"));
    EXPECT_EQ(all_lines(read), "s.toml:2: level is not a number; there are levels 1, 2 and 3\n");
}

// Of every exercise, whatever is set.
TEST(Rehab, IsMadeAnewOfItsSettings) {
    for (const ExerciseKind& kind : exercise_kinds()) {
        SettingValues values(kind.settings);
        for (const SettingKind& setting : kind.settings) {
            if (!setting.words.empty())
                EXPECT_TRUE(values.set(setting.key, setting.words.back()));
            else
                values.set(setting.key,
                           setting.whole ? setting.most : setting.least + 0.1 * (setting.most - setting.least));
        }
        ASSERT_TRUE(problems(values).empty());
        const Rehab rehab(kind.make(values));
        const auto again = exercise_of(rehab.settings());
        ASSERT_TRUE(again) << rehab.settings();
        EXPECT_EQ((*again)->settings(), values);
        EXPECT_STREQ((*again)->name(), kind.name);
    }
    const std::string ball = "rehab ball --colour green --level 2 --repetitions 7 --hold 0.5 --time-limit 33.5";
    const std::string game = "rehab game --speed slow --level 1 --throws 1 --time-limit 120 --open 0 --closed 1";
    for (const std::string& recorded : {ball, game}) {
        auto made = exercise_of(recorded);
        ASSERT_TRUE(made) << "the lines of recordings that there are: " << recorded;
        EXPECT_EQ(Rehab(std::move(*made)).settings(), recorded) << "a replay compares it with what was recorded";
    }
    for (const char* wrong : {"rehab", "rehab ball", "rehab balls --level 1", "rehab ball --colour red",
                              "rehab ball --colour red --level 4 --repetitions 5 --hold 1 --time-limit 60",
                              "rehab ball --colour pink --level 1 --repetitions 5 --hold 1 --time-limit 60"})
        EXPECT_FALSE(exercise_of(wrong)) << wrong;
}

// The ball that gives stands where the world's own is, and is as large.
TEST(Rehab, PutsItsBallInThePlaceOfTheWorlds) {
    const auto world = scene::read_any_world("assets/worlds/hand.toml");
    ASSERT_TRUE(world);
    const ExerciseKind& kind = *exercise_named("ball");
    Rehab exercise(kind.make(SettingValues(kind.settings)));
    const auto* body = dynamic_cast<const bodies::SoftPart*>(exercise.scene_part());
    ASSERT_NE(body, nullptr);
    const scene::SceneObject& ball = world->objects.at(body->setup().object - 1);
    EXPECT_EQ(ball.name, "ball");
    Box box;
    for (const Vec3& place : ball.mesh->positions_m) box.include(ball.pose * (ball.scale * place));
    EXPECT_LT(glm::length(box.center() - body->setup().scene_from_body.position_m), 1e-4);
    EXPECT_LT(glm::length(0.5 * box.extent() - body->setup().half_axes_m), 2e-4);
}

TEST(ScriptedSqueezes, AreAsManyLongOnesAsAreAskedForWhateverTheSeed) {
    std::size_t too_short = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto squeezes = drawn_squeezes({.repetitions = 6, .hold_s = 1.0}, seed, 3.0);
        EXPECT_EQ(std::ranges::count(squeezes, false, &ScriptedSqueeze::too_short), 6);
        too_short += static_cast<std::size_t>(std::ranges::count(squeezes, true, &ScriptedSqueeze::too_short));
        double last_s = 3.0;
        for (const ScriptedSqueeze& squeeze : squeezes) {
            EXPECT_GE(squeeze.closes_s, last_s);
            EXPECT_GT(squeeze.opens_s, squeeze.closes_s);
            last_s = squeeze.opens_s;
        }
    }
    EXPECT_GT(too_short, 100u);
    EXPECT_NE(drawn_squeezes({}, 1, 3.0).back().opens_s, drawn_squeezes({}, 2, 3.0).back().opens_s);
}

TEST(ScriptedSqueezes, TakeThePlaceOfTheScripts) {
    const std::string text = with_squeezes(
        "burin-input 1 x\n0.5 mouse 1 2\n1.000 button press left\n9.0 command quit\n", {{1.5, 3.0, false}});
    EXPECT_EQ(text,
              "burin-input 1 x\n0.5 mouse 1 2\n1.500 button press left\n2.950 command screenshot squeezed.png\n"
              "3.000 button release left\n4.600 command quit\n");
}

}  // namespace burin::activities
