// SPDX-License-Identifier: MIT
// An exercise's start, which asks each finger to press once: what counts as pressed, and what is told of one that gave
// nothing.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/rehab.hpp"
#include "tests/activities/acted_hand.hpp"

namespace burin::activities {
namespace {

// Its body takes the place of object 2, which is the table of the acted hand.
std::unique_ptr<Rehab> rehab_that_starts(const char* exercise, const char* start = "pressed") {
    const ExerciseKind& kind = *exercise_named(exercise);
    SettingValues values(kind.settings);
    EXPECT_TRUE(values.set("start", start));
    return std::make_unique<Rehab>(kind.make(values));
}

void push_all(ActedHand& hand, const FingerForces& told_N, const FingerForces& given_N) {
    for (std::size_t i = 0; i < kFelt; ++i) {
        hand.touch(i, kTable, {0.0, 1.0, 0.0});
        hand.push(i, told_N[i]);
        hand.measure(i, given_N[i]);
    }
}

}  // namespace

TEST(StartCheck, TheTimeBeginsWhenEachFingerHasPressed) {
    const auto rehab = rehab_that_starts("ball");
    ActedHand hand;
    const auto asked = hand.go_on(*rehab, 3000).messages;
    ASSERT_EQ(asked.size(), 1u);
    EXPECT_EQ(asked[0], "press with each finger once: thumb, index, middle, ring; then the time begins");
    EXPECT_TRUE(rehab->exercise().course().events.empty());
    EXPECT_TRUE(rehab->panel().page.contains("Press with each finger once")) << rehab->panel().page;
    // One after the other, in whatever order.
    for (const std::size_t finger : {2u, 0u, 3u, 1u}) {
        EXPECT_TRUE(rehab->exercise().course().events.empty()) << finger;
        FingerForces forces_N{};
        forces_N[finger] = 0.5;
        push_all(hand, forces_N, forces_N);
        hand.go_on(*rehab, 150);
        push_all(hand, {}, {});
        hand.go_on(*rehab, 50);
    }
    ASSERT_FALSE(rehab->exercise().course().events.empty());
    EXPECT_EQ(rehab->exercise().course().events.front().what, "begun");
    hand.go_on(*rehab, 1000);
    EXPECT_NEAR(rehab->exercise().course().time_s, 1.1, 0.06) << "since then, and not since the session began";
    const Json report = rehab->report();
    for (const Json& finger : report["fingers"]) EXPECT_EQ(finger["pressed_at_start"], true);
}

TEST(StartCheck, AFingerThatGaveNothingIsToldAndItsMeasuresSaySo) {
    for (std::size_t dead = 0; dead < kFelt; ++dead) {
        const auto rehab = rehab_that_starts("ball");
        ActedHand hand;
        FingerForces given_N{0.8, 0.8, 0.8, 0.8};
        given_N[dead] = 0.0;
        push_all(hand, {0.8, 0.8, 0.8, 0.8}, given_N);  // it is told as much as the others
        hand.go_on(*rehab, 4000);
        EXPECT_TRUE(rehab->exercise().course().events.empty()) << "it is waited for";
        const auto told = hand.go_on(*rehab, 2000).messages;
        ASSERT_FALSE(told.empty());
        EXPECT_EQ(told[0], "gave nothing when they were to press: " + std::string(kFingerNames[dead]) +
                               "; the time begins without, and what is measured of them says so");
        EXPECT_FALSE(rehab->exercise().course().events.empty());
        const Json report = rehab->report();
        for (std::size_t i = 0; i < kFelt; ++i) EXPECT_EQ(report["fingers"][i]["pressed_at_start"], i != dead) << i;
    }
}

TEST(StartCheck, NobodyIsWaitedForForEver) {
    const auto rehab = rehab_that_starts("ball");
    ActedHand hand;
    hand.go_on(*rehab, 19'900);
    EXPECT_TRUE(rehab->exercise().course().events.empty());
    hand.go_on(*rehab, 200);
    EXPECT_FALSE(rehab->exercise().course().events.empty());
    EXPECT_EQ(rehab->report()["fingers"][0]["pressed_at_start"], false);
}

// The press that begins the time is none of the exercise's, however long it lasts.
TEST(StartCheck, WhatIsPressedCountsOnceTheHandHasLetGo) {
    const auto rehab = rehab_that_starts("putty");
    const auto kneads = [&] { return rehab->exercise().course().counts.at(0).number; };
    ActedHand hand;
    const FingerForces pinch_N{1.5, 1.5, 0.0, 0.0};
    push_all(hand, pinch_N, pinch_N);
    hand.go_on(*rehab, 2000);
    EXPECT_GT(rehab->exercise().course().time_s, 1.8);
    EXPECT_EQ(kneads(), 0u);
    EXPECT_EQ(rehab->report()["person_range"], Json()) << "nor is it the person's force";
    EXPECT_EQ(rehab->report()["fingers"][0]["peak_force_N"], 0.0);
    push_all(hand, {}, {});
    hand.go_on(*rehab, 200);
    push_all(hand, pinch_N, pinch_N);
    hand.go_on(*rehab, 400);
    EXPECT_EQ(kneads(), 1u);
    EXPECT_EQ(rehab->report()["fingers"][0]["peak_force_N"], 1.5);
}

// Motors that are off for 20 s are no run that a person has done badly.
TEST(StartCheck, ADeviceThatHasAFaultAtEachFingerBreaksOff) {
    for (const bool one_works : {false, true}) {
        const auto rehab = rehab_that_starts("ball");
        ActedHand hand;
        for (std::size_t i = one_works ? 1 : 0; i < kFelt; ++i) hand.have_fault(i, devices::DeviceFault::motors_off);
        hand.go_on(*rehab, 19'900);
        const auto told = hand.go_on(*rehab, 200).messages;
        hand.go_on(*rehab, 1000);
        const Json report = rehab->report();
        EXPECT_EQ(rehab->exercise().course().events.empty(), !one_works);
        EXPECT_EQ(report["broken_off_because"].is_string(), !one_works);
        if (one_works) continue;
        EXPECT_EQ(report["ended"], "broken off");
        ASSERT_EQ(told.size(), 1u);
        EXPECT_TRUE(told[0].starts_with("broken off: the device had a fault at each finger")) << told[0];
        EXPECT_TRUE(rehab->panel().page.starts_with("Broken off")) << rehab->panel().page;
    }
}

// A pinch is asked of two fingers; what was recorded before, and a simulated glove, begin at once.
TEST(StartCheck, AsksForTheFingersOfTheExerciseAndOnlyWhereItIsToAsk) {
    const auto pinch = rehab_that_starts("putty");
    ActedHand hand;
    EXPECT_EQ(hand.go_on(*pinch, 1).messages.at(0), "press with each finger once: thumb, index; then the time begins");
    push_all(hand, {0.5, 0.5, 0.0, 0.0}, {0.5, 0.5, 0.0, 0.0});
    hand.go_on(*pinch, 200);
    EXPECT_FALSE(pinch->exercise().course().events.empty());
    EXPECT_EQ(pinch->report()["fingers"][3]["pressed_at_start"], Json());
    const auto old = exercise_of("rehab ball --colour red --level 2 --repetitions 7 --hold 0.5 --time-limit 33.5");
    ASSERT_TRUE(old);
    EXPECT_EQ((*old)->settings().number("start"), kStartsAtOnce);
    for (const char* start : {"at_once", "by_device"}) {
        const auto rehab = rehab_that_starts("ball", start);
        hand.go_on(*rehab, 1);
        EXPECT_FALSE(rehab->exercise().course().events.empty()) << start;
        EXPECT_EQ(rehab->report()["fingers"][0]["pressed_at_start"], Json());
    }
}

}  // namespace burin::activities
