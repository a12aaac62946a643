// SPDX-License-Identifier: MIT
// The putty exercise: its rules turn by turn, its settings' table, its body, its scripted participant.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/putty/putty.hpp"
#include "activities/rehab/putty/scripted_kneads.hpp"
#include "base/assets.hpp"
#include "base/file_io.hpp"

namespace burin::activities {
namespace {

// An exercise whose fingers press for a time, a turn each millisecond.
class Kneading {
public:
    explicit Kneading(const PuttySettings& settings) : settings_(settings) {}
    void press(double for_s, const FingerForces& forces_N) {
        for (int i = 0; i < static_cast<int>(for_s * 1000.0 + 0.5); ++i) {
            ExerciseTurn turn;
            turn.time_ns = now_ns_;
            turn.fingers.dt_s = 0.001;
            turn.fingers.forces_N = forces_N;
            PuttyStep step = step_putty(state_, settings_, turn);
            state_ = step.state;
            for (const ExerciseEvent& event : step.events) events_.push_back(event.what);
            now_ns_ += 1'000'000;
        }
    }
    void pinch(double for_s, double force_N) { press(for_s, {0.5 * force_N, 0.5 * force_N, 0.0, 0.0}); }
    void whole(double for_s, double force_N) {
        press(for_s, {0.25 * force_N, 0.25 * force_N, 0.25 * force_N, 0.25 * force_N});
    }
    [[nodiscard]] const PuttyState& state() const { return state_; }
    [[nodiscard]] const std::vector<std::string_view>& events() const { return events_; }

private:
    PuttySettings settings_;
    PuttyState state_;
    std::vector<std::string_view> events_;
    Nanoseconds now_ns_ = 5'000'000'000;
};

}  // namespace

TEST(PuttyExercise, CountsAKneadThatReachesItsForceAndRelaxes) {
    const PuttySettings settings{.level = 2, .kneads = 2};  // a pinch of 2.5 N
    Kneading putty(settings);
    putty.pinch(0.5, 0.0);
    putty.pinch(3.0, 2.6);
    EXPECT_EQ(putty.state().kneads, 1u) << "one knead counts once, however long it lasts";
    putty.pinch(0.1, 1.0);
    putty.pinch(1.0, 2.6);
    EXPECT_EQ(putty.state().kneads, 1u) << "the next counts after it has relaxed";
    putty.pinch(0.1, 0.6);
    putty.pinch(0.3, 2.6);
    EXPECT_EQ(putty.state().end, ExerciseEnd::done);
    using namespace putty_event;
    EXPECT_EQ(putty.events(), (std::vector{kBegun, kPressed, kKneaded, kPressed, kKneaded, kDone}));
    EXPECT_DOUBLE_EQ(score_of(putty.state(), settings), 100.0);
}

// Whatever the attempt before was, each counts as what it is.
TEST(PuttyExercise, CountsEachAttemptAsItWouldTheFirst) {
    enum class Attempt { kneaded, wrong, weak, broken };
    constexpr std::array kAttempts{Attempt::kneaded, Attempt::wrong, Attempt::weak, Attempt::broken};
    const PuttySettings settings{.level = 2, .kneads = 100, .time_limit_s = 1000.0};  // a pinch of 2.5 N
    for (const Attempt before : kAttempts)
        for (const Attempt attempt : kAttempts) {
            Kneading putty(settings);
            unsigned kneads = 0, too_weak = 0, wrong_grip = 0;
            for (const Attempt one : {before, attempt, before}) {
                if (one == Attempt::kneaded) putty.pinch(0.5, 2.6), ++kneads;
                if (one == Attempt::wrong) putty.whole(0.5, 2.6), ++wrong_grip;
                if (one == Attempt::weak) putty.pinch(0.5, 2.4), ++too_weak;
                if (one == Attempt::broken) {  // the right grip, never for as long as a knead takes
                    for (int time = 0; time < 3; ++time) putty.pinch(0.15, 2.6), putty.whole(0.01, 2.6);
                    ++wrong_grip;
                }
                putty.pinch(0.1, 0.0);
                const std::string of =
                    std::to_string(static_cast<int>(attempt)) + " after " + std::to_string(static_cast<int>(before));
                EXPECT_EQ(putty.state().kneads, kneads) << of;
                EXPECT_EQ(putty.state().too_weak, too_weak) << of;
                EXPECT_EQ(putty.state().wrong_grip, wrong_grip) << of;
            }
        }
}

TEST(PuttyExercise, TellsWhatIsTooWeak) {
    const PuttySettings settings{.shape = PuttyShape::ellipsoid, .kneads = 4};  // 3 N
    Kneading putty(settings);
    putty.whole(1.0, 1.4);
    putty.whole(0.1, 0.0);
    EXPECT_EQ(putty.state().too_weak, 0u) << "that was no attempt";
    putty.whole(1.0, 2.9);
    putty.whole(0.1, 0.0);
    EXPECT_EQ(putty.state().too_weak, 1u);
    putty.whole(1.0, 3.0);
    putty.whole(0.1, 0.0);
    EXPECT_EQ(putty.state().kneads, 1u);
    EXPECT_DOUBLE_EQ(score_of(putty.state(), settings), 22.5);
}

TEST(PuttyExercise, TakesThePinchAndTheWholeGripForWhatTheyAre) {
    Kneading ball({.shape = PuttyShape::ball}), ellipsoid({.shape = PuttyShape::ellipsoid});
    ball.whole(1.0, 6.0);
    ball.whole(0.1, 0.0);
    EXPECT_EQ(ball.state().wrong_grip, 1u);
    ball.pinch(0.19, 6.0);
    ball.pinch(0.1, 0.0);
    EXPECT_EQ(ball.state().wrong_grip, 2u) << "the grip is to be held for 0.2 s";
    ball.pinch(0.3, 6.0);
    EXPECT_EQ(ball.state().kneads, 1u);
    ellipsoid.pinch(1.0, 6.0);
    ellipsoid.pinch(0.1, 0.0);
    ellipsoid.press(1.0, {2.0, 2.0, 2.0, 0.1});
    ellipsoid.pinch(0.1, 0.0);
    EXPECT_EQ(ellipsoid.state().wrong_grip, 2u);
    ellipsoid.press(1.0, {2.0, 2.0, 2.0, 0.2});
    EXPECT_EQ(ellipsoid.state().kneads, 1u);
}

TEST(PuttyExercise, EndsWithItsTimeAndStaysAsItIsThen) {
    Kneading putty({.time_limit_s = 0.5});
    putty.pinch(0.6, 1.0);
    EXPECT_EQ(putty.state().end, ExerciseEnd::time_over);
    EXPECT_NEAR(putty.state().time_s(), 0.5, 1e-9);
    const PuttyState then = putty.state();
    putty.pinch(5.0, 9.0);
    EXPECT_EQ(putty.state(), then);
}

TEST(PuttySettings, TellEachMistakeWithItsLine) {
    const ExerciseKind* const kind = exercise_named("putty");
    ASSERT_NE(kind, nullptr);
    const ReadSettings read = read_settings(
        "[putty]\nshap = \"ball\"\nshape = \"cube\"\nhardness = \"stone\"\nlevel = 0\nkneads = 0\n"
        "time_limit_s = 1e-300\n",
        "s.toml", *kind);
    std::string text;
    for (const Error& error : read.errors) text += error.line() + "\n";
    for (const char* line : {"s.toml:2: [putty] has no key named shap; did you mean shape?",
                             "s.toml:3: shape is cube; there are ball, ellipsoid",
                             "s.toml:4: hardness is stone; there are soft, medium, firm", "s.toml:5: level is 0",
                             "s.toml:6: kneads is 0", "s.toml:7: time_limit_s is 1e-300"})
        EXPECT_TRUE(text.contains(line)) << line << " is missing in\n" << text;
    EXPECT_EQ(read.errors.size(), 6u) << text;
}

TEST(PuttySettings, MakeTheExerciseAnewFromARecordingsLine) {
    SettingValues values(Putty::setting_kinds());
    ASSERT_TRUE(values.set("shape", "ellipsoid"));
    ASSERT_TRUE(values.set("hardness", "firm"));
    values.set("level", 3.0);
    values.set("time_limit_s", 33.3);
    const auto again = exercise_of("rehab putty " + line_of(values));
    ASSERT_TRUE(again) << again.error().line();
    EXPECT_EQ((*again)->settings(), values);
    EXPECT_FALSE(exercise_of("rehab putty --shape cube"));
}

TEST(Putty, HasABodyThatFlowsTheHarderTheStiffer) {
    double last_Pa = 0.0;
    for (const char* hardness : {"soft", "medium", "firm"})
        for (const char* shape : {"ball", "ellipsoid"}) {
            SettingValues values(Putty::setting_kinds());
            ASSERT_TRUE(values.set("hardness", hardness));
            ASSERT_TRUE(values.set("shape", shape));
            const bodies::SoftPartSetup setup = Putty(values).body();
            EXPECT_TRUE(setup.material.is_plastic());
            EXPECT_GE(setup.material.yield_Pa, last_Pa);
            EXPECT_TRUE(bodies::SoftPart::create(setup));
            EXPECT_EQ(Putty::grip(values), std::string_view(shape) == "ball" ? "pinch" : "whole");
            last_Pa = setup.material.yield_Pa * (std::string_view(shape) == "ellipsoid" ? 1.5 : 1.0);
        }
}

TEST(ScriptedKneads, AreAsManyAsAreAskedForWhateverTheSeed) {
    std::ptrdiff_t misses = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto kneads = drawn_kneads({.kneads = 6}, seed, 3.0);
        EXPECT_EQ(std::ranges::count(kneads, false, &ScriptedKnead::misses), 6);
        misses += std::ranges::count(kneads, true, &ScriptedKnead::misses);
        double last_s = 3.0;
        for (const ScriptedKnead& knead : kneads) {
            EXPECT_GE(knead.closes_s, last_s);
            EXPECT_GT(knead.opens_s, knead.closes_s);
            last_s = knead.opens_s;
        }
    }
    EXPECT_GT(misses, 100);
}

TEST(ScriptedKneads, BringAWholeHandLessFarThanAPinch) {
    const auto script = read_text_file(asset_path(exercise_named("putty")->script));
    ASSERT_TRUE(script);
    SettingValues values(Putty::setting_kinds());
    const std::string pinch = scripted_putty(values, 1, *script);
    ASSERT_TRUE(values.set("shape", "ellipsoid"));
    const std::string whole = scripted_putty(values, 1, *script);
    const auto moves = [](const std::string& text) {
        std::size_t count = 0;
        for (std::size_t at = text.find(" mouse "); at != std::string::npos; at = text.find(" mouse ", at + 1)) ++count;
        return count;
    };
    EXPECT_EQ(moves(pinch), moves(whole) + 8);
    EXPECT_TRUE(whole.contains("command quit"));
}

}  // namespace burin::activities
