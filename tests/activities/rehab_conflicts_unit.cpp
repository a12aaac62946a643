// SPDX-License-Identifier: MIT
// Settings of exercises that are sound each by itself and cannot be met together.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/rehab.hpp"

namespace burin::activities {
namespace {

std::string conflict_of(const char* exercise, const std::vector<std::pair<const char*, double>>& with) {
    const ExerciseKind& kind = *exercise_named(exercise);
    SettingValues values(kind.settings);
    for (const auto& [key, value] : with) values.set(key, value);
    EXPECT_TRUE(problems(values).empty());
    const std::optional<Error> conflict = kind.conflict(values);
    return conflict ? conflict->line() : "";
}

}  // namespace

TEST(RehabConflicts, AreRefusedWithTheirArithmetic) {
    EXPECT_EQ(conflict_of("ball", {{"repetitions", 5}, {"hold_s", 60}}),
              "time_limit_s: 5 squeezes of 60 s and 4 rests of 0.25 s take 301 s at least, and it ends after 60 s; ask "
              "for less, or for more time");
    EXPECT_EQ(conflict_of("ball", {{"repetitions", 5}, {"hold_s", 60}, {"time_limit_s", 301}}), "");
    EXPECT_NE(conflict_of("ball", {{"repetitions", 5}, {"hold_s", 60}, {"time_limit_s", 300.9}}), "");
    EXPECT_EQ(conflict_of("ball", {{"repetitions", 1}, {"hold_s", 0}, {"time_limit_s", 0.1}}), "");
    EXPECT_EQ(conflict_of("putty", {{"kneads", 301}, {"time_limit_s", 60}}),
              "time_limit_s: 301 kneads of 0.2 s take 60.2 s at least, and it ends after 60 s; ask for less, or for "
              "more time");
    EXPECT_EQ(conflict_of("putty", {{"kneads", 300}, {"time_limit_s", 60}}), "");
    EXPECT_NE(conflict_of("game", {{"throws", 1000}}), "");
    EXPECT_EQ(conflict_of("game", {{"start", kStartsPressed}}),
              "start: is pressed, and nobody presses in the game; give asked or at_once");
    for (const ExerciseKind& kind : exercise_kinds()) EXPECT_EQ(conflict_of(kind.name, {}), "") << "as it usually is";
}

TEST(RehabConflicts, ATargetThatAnyTouchReachesIsRefusedWithItsArithmetic) {
    EXPECT_EQ(
        conflict_of("ball", {{"most_N", 0.01}}),
        "most_N: 0.25 of 0.01 N is a target of 0.0025 N, and any touch reaches one of less than 0.1 N; give 0.4 N "
        "or more, or 0: not known");
    EXPECT_EQ(conflict_of("ball", {{"most_N", 0.4}}), "");
    EXPECT_EQ(conflict_of("putty", {{"most_N", 0.0}}), "");
    EXPECT_NE(conflict_of("putty", {{"most_N", 0.19}, {"level", 2}}), "");
}

TEST(RehabConflicts, AFileOfSettingsHasNumbersAsTheyWereGiven) {
    SettingValues values(exercise_named("ball")->settings);
    values.set("share", 0.1);
    values.set("open", -0.0);
    const std::string text = table_text("ball", values);
    EXPECT_TRUE(text.contains("share = 0.1\n") && text.contains("open = 0\n")) << text;
    EXPECT_TRUE(text.contains("colour = \"red\"\n")) << text;
}

// What was recorded with such settings is replayed all the same.
TEST(RehabConflicts, OfARecordingAreNone) {
    EXPECT_TRUE(exercise_of("rehab ball --colour green --level 2 --repetitions 7 --hold 60 --time-limit 33.5"));
}

}  // namespace burin::activities
