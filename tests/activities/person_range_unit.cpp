// SPDX-License-Identifier: MIT
// Exercises that are fitted to a person: targets are shares of the force that the hand has, closures of its way.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "activities/rehab/ball/ball.hpp"
#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/game/game.hpp"
#include "activities/rehab/putty/putty.hpp"
#include "activities/rehab/rehab.hpp"
#include "tests/activities/acted_hand.hpp"

namespace burin::activities {
namespace {

std::unique_ptr<Rehab> fitted_rehab(const char* exercise, const std::vector<std::pair<const char*, double>>& with) {
    const ExerciseKind& kind = *exercise_named(exercise);
    SettingValues values(kind.settings);
    for (const auto& [key, value] : with) values.set(key, value);
    EXPECT_TRUE(problems(values).empty());
    return std::make_unique<Rehab>(kind.make(values));
}

bool holds_ball(const Rehab& rehab) {
    return rehab.exercise().course().counts.at(2).number > 0;  // grasps
}

}  // namespace

TEST(PersonRange, TargetsAreSharesOfThePersonsForceWhereThatIsKnown) {
    for (unsigned level = 1; level <= 3; ++level) {
        EXPECT_DOUBLE_EQ((BallSettings{.level = level}).target_N(), 2.0 * level);
        EXPECT_DOUBLE_EQ((BallSettings{.level = level, .most_N = 4.0}).target_N(), 1.0 * level);
        EXPECT_DOUBLE_EQ((PuttySettings{.level = level, .most_N = 2.0}).target_N(), 0.5 * level);
    }
    const BallSettings weak{.share = 0.1, .most_N = 4.0};
    EXPECT_DOUBLE_EQ(weak.of_each_N(), 0.1);
}

// A hand that closes by half of the usual way, and grasps a ball with the same share of its own.
TEST(PersonRange, AGraspIsToldByTheShareOfThePersonsWay) {
    for (const bool fitted : {false, true}) {
        const auto rehab = fitted_rehab("ball", fitted ? std::vector<std::pair<const char*, double>>{{"closed", 0.3}}
                                                       : std::vector<std::pair<const char*, double>>{});
        ActedHand hand;
        hand.touch(0, kTable, {0.0, 0.0, -1.0});
        for (std::size_t finger = 1; finger < kFelt; ++finger) hand.touch(finger, kTable, {0.0, 0.1, 1.0});
        for (std::size_t finger = 0; finger < kFelt; ++finger)
            for (std::size_t joint = 1; joint < 4; ++joint) hand.bend_joint(finger, joint, 0.1);
        session::WorldObjects objects = ball_on_a_table();
        // Object 2 has the size of a ball here, so that a hand may grasp it.
        auto small = std::make_shared<scene::SceneObject>(*objects.objects[1]);
        small->mesh = objects.objects[0]->mesh;
        objects.objects[1] = small;
        hand.go_on(*rehab, 100, objects);
        EXPECT_EQ(holds_ball(*rehab), fitted);
    }
}

// A hand that presses as it should, but is not closed by the range that is set, is told why that does not count.
TEST(PersonRange, AForceWithoutAGraspIsToldAndNoted) {
    const auto rehab = fitted_rehab("ball", {{"closed", 1.5}});
    ActedHand hand;
    for (std::size_t finger = 0; finger < kFelt; ++finger) {
        hand.touch(finger, kTable, {0.0, 1.0, 0.0});
        hand.push(finger, 1.0);
    }
    EXPECT_EQ(rehab->report()["notes"], Json::array());
    const auto told = hand.go_on(*rehab, 3000).messages;
    ASSERT_EQ(told.size(), 1u);
    EXPECT_TRUE(told[0].starts_with("4.0 N do not count: the hand does not grasp the ball")) << told[0];
    const Json notes = rehab->report()["notes"];
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(notes[0].get<std::string>().starts_with("the force was reached once")) << notes[0];
    EXPECT_EQ(rehab->exercise().course().counts.at(0).number, 0u);
}

TEST(PersonRange, LinesOfRecordingsThatLackItAreOfTheUsualHand) {
    const auto old = exercise_of("rehab game --speed slow --level 1 --throws 5 --time-limit 120");
    ASSERT_TRUE(old);
    EXPECT_EQ(range_of((*old)->settings()), PersonRange{});
    for (const double closure : {0.0, 0.123456789, 0.7, 1.1})
        EXPECT_EQ(PersonRange{}.share_of(closure), closure) << "to the bit";
    EXPECT_DOUBLE_EQ((PersonRange{0.2, 0.6}).share_of(0.4), 0.5);
}

TEST(PersonRange, OneThatLeavesNoWayIsRefusedWithTheArithmetic) {
    for (const ExerciseKind& kind : exercise_kinds()) {
        SettingValues values(kind.settings);
        if (!values.has("open")) continue;  // an assessment measures it
        values.set("open", 0.5);
        values.set("closed", 0.625);
        const auto conflict = kind.conflict(values);
        ASSERT_TRUE(conflict) << kind.name;
        EXPECT_TRUE(conflict->line().contains("0.625 - 0.5 = 0.125")) << conflict->line();
        values.set("closed", 0.3);
        EXPECT_TRUE(kind.conflict(values)) << kind.name;
        values.set("closed", 0.65);
        EXPECT_FALSE(kind.conflict(values)) << kind.name;
    }
}

// What a run shows of a hand is what the next one takes.
TEST(PersonRange, AReportTellsTheWayAndTheForceThatTheHandHasShown) {
    const auto rehab = fitted_rehab("ball", {});
    ActedHand hand;
    EXPECT_EQ(rehab->report()["person_range"], Json()) << "nothing was read";
    const auto bend = [&](double angle_rad) {
        for (std::size_t finger = 0; finger < kFelt; ++finger)
            for (std::size_t joint = 1; joint < 4; ++joint) hand.bend_joint(finger, joint, angle_rad);
    };
    bend(0.1);
    hand.go_on(*rehab, 300);
    bend(0.5);
    for (std::size_t finger = 0; finger < kFelt; ++finger) {
        hand.touch(finger, kTable, {0.0, 1.0, 0.0});
        hand.push(finger, 0.75);
        hand.measure(finger, 0.5);
    }
    hand.go_on(*rehab, 3000);
    // What stopped it there may have been the body: how far it closes is not known.
    const Json stopped = rehab->report()["person_range"];
    EXPECT_FALSE(stopped.contains("closed")) << stopped.dump();
    EXPECT_FALSE(stopped.contains("open")) << "one end alone fits no hand";
    EXPECT_EQ(stopped["way_left_out"],
              "stopped where it closed farthest: thumb, index, middle, ring; close the hand once with nothing in it");
    for (std::size_t finger = 0; finger < kFelt; ++finger) {
        hand.push(finger, 0.0);
        hand.measure(finger, 0.0);
    }
    bend(0.51);
    hand.go_on(*rehab, 300);
    EXPECT_FALSE(rehab->report()["person_range"].contains("closed")) << "hardly farther than it was stopped";
    bend(0.7);
    hand.go_on(*rehab, 300);
    const Json shown = rehab->report()["person_range"];
    EXPECT_FALSE(shown.contains("way_left_out")) << shown.dump();
    double open = 0.0, closed = 0.0;
    for (std::size_t finger = 0; finger < kFelt; ++finger) {
        const auto of = static_cast<geometry::Finger>(finger);
        open += 0.25 * geometry::closure_of(of, {0.0, 0.1, 0.1, 0.1});
        closed += 0.25 * geometry::closure_of(of, {0.0, 0.7, 0.7, 0.7});
    }
    EXPECT_NEAR(shown["open"].get<double>(), open, 1e-9);
    EXPECT_NEAR(shown["closed"].get<double>(), closed, 1e-9);
    EXPECT_NEAR(shown["most_N"].get<double>(), 2.0, 0.01) << "by what is given, and not by what is told";
}

}  // namespace burin::activities
