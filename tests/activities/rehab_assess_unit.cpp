// SPDX-License-Identifier: MIT
// The assessment: what it measures of hands whose fingers follow a known course, by formulas of that course.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "activities/rehab/assess/assess.hpp"
#include "activities/rehab/assess/scripted_fingers.hpp"
#include "activities/rehab/exercise_kinds.hpp"
#include "devices/gloves/finger_course.hpp"
#include "geometry/hand/hand_joints.hpp"

namespace burin::activities {
namespace {

using devices::GripShape;

constexpr double kAssessTurn_s = 0.001;

// The flexion from open to closed by a share of 1.
double stroke_rad(std::size_t finger) {
    const auto open = devices::bent_in(GripShape::whole, finger, 0.0),
               shut = devices::bent_in(GripShape::whole, finger, 1.0);
    double sum = 0.0;
    for (std::size_t joint = 1; joint < open.size(); ++joint) sum += shut[joint] - open[joint];
    return sum;
}

// Has a hand go through the assessment: it is where its course has it, and gives its force as long as it presses.
template <typename Change>
AssessState after_assessment(const AssessedHand& hand, Change change) {
    const devices::FingerCourse course = assess_course_of(hand);
    AssessState state;
    for (std::size_t i = 0; state.end == ExerciseEnd::not_yet && i < 200'000; ++i) {
        const double at_s = static_cast<double>(i) * kAssessTurn_s;
        ExerciseTurn turn;
        turn.time_ns = nanoseconds(1.0 + at_s);
        turn.fingers.dt_s = i > 0 ? kAssessTurn_s : 0.0;
        const auto closed = course.closed_at(at_s);
        const bool presses =
            state.measures && assess_parts()[state.part].task == AssessTask::press && closed[0] > 0.99 * hand.closes;
        for (std::size_t finger = 0; finger < closed.size(); ++finger) {
            turn.fingers.joints_rad[finger] = devices::bent_in(GripShape::whole, finger, closed[finger]);
            turn.fingers.drive_N[finger] = presses ? hand.holds_N[finger] : 0.0;
        }
        change(at_s, state, turn.fingers);
        state = step_assessment(std::move(state), turn).state;
    }
    return state;
}

void as_it_is(double, const AssessState&, FingersTurn&) {}

}  // namespace

TEST(Assessment, TakesAMinuteAndAHalfAndItsPartsOneAfterTheOther) {
    EXPECT_DOUBLE_EQ(assess_begins_s(0), 3.0);
    EXPECT_DOUBLE_EQ(assess_begins_s(kAssessParts) - kReads_s, 9 * 3.0 + 12.0 + 3 * 5.0 + 8.0 + 4 * 8.0);
    const AssessState state = after_assessment({}, as_it_is);
    EXPECT_EQ(state.end, ExerciseEnd::done);
    EXPECT_NEAR(state.time_s(), 94.0, 0.0015);
    EXPECT_EQ(assessed(state).measured_parts(), kAssessParts);
}

TEST(Assessment, MeasuresWhatTheCourseOfAHandForetells) {
    for (const SimulatedPerson person : {SimulatedPerson::healthy, SimulatedPerson::weak}) {
        const AssessedHand hand = assessed_hand(person);
        const Assessed found = assessed(after_assessment(hand, as_it_is));
        double together_N = 0.0;
        for (std::size_t i = 0; i < found.fingers.size(); ++i) {
            const AssessedFinger& finger = found.fingers[i];
            const auto open = devices::bent_in(GripShape::whole, i, 0.0),
                       shut = devices::bent_in(GripShape::whole, i, 1.0);
            for (std::size_t joint = 0; joint < open.size(); ++joint)
                EXPECT_NEAR(finger.range_rad[joint].value(), hand.closes * std::abs(shut[joint] - open[joint]), 1e-9);
            EXPECT_NEAR(finger.strength_N.value(), hand.holds_N[i], 1e-12);
            together_N += hand.holds_N[i];
            EXPECT_NEAR(finger.peak_rad_per_s.value(), hand.closes * std::abs(stroke_rad(i)) / hand.stroke_s, 1e-6);
            double slopes = 0.0;
            for (std::size_t k = 0; k < found.fingers.size(); ++k)
                if (k != i) slopes += hand.others_follow * std::abs(stroke_rad(k) / stroke_rad(i));
            EXPECT_NEAR(finger.fractionation.value(), 1.0 - slopes / 3.0, 1e-6) << i;
        }
        EXPECT_NEAR(found.together_N.value(), together_N, 1e-12);
    }
    // Half as far, and an index that does not press, as the patient of the test is made.
    const Assessed healthy = assessed(after_assessment(assessed_hand(SimulatedPerson::healthy), as_it_is)),
                   weak = assessed(after_assessment(assessed_hand(SimulatedPerson::weak), as_it_is));
    for (std::size_t i = 1; i < weak.fingers.size(); ++i)  // an open thumb is bent backwards, which is a closure of 0
        EXPECT_NEAR(*weak.fingers[i].closed - *weak.fingers[i].open,
                    0.5 * (*healthy.fingers[i].closed - *healthy.fingers[i].open), 1e-9);
    EXPECT_EQ(weak.fingers[1].strength_N, 0.0);
}

// A finger of which it is asked to move alone, whose neighbour shakes on its own: a slope of nothing.
TEST(Assessment, TakesForFollowingWhatGoesWithTheInstructedFingerAlone) {
    const AssessedHand hand{.closes = 1.0, .others_follow = 0.0, .stroke_s = 0.25};
    const AssessState state = after_assessment(hand, [](double at_s, const AssessState& now, FingersTurn& turn) {
        if (!now.measures || assess_parts()[now.part].task != AssessTask::alone) return;
        const std::size_t other = (assess_parts()[now.part].finger + 1) % 4;
        turn.joints_rad[other][1] += 0.1 * std::sin(2.0 * std::numbers::pi * 10.0 * at_s);
    });
    for (const AssessedFinger& finger : assessed(state).fingers) EXPECT_NEAR(finger.fractionation.value(), 1.0, 0.01);
}

TEST(Assessment, TakesNoForceForStrengthThatWasNotHeld) {
    const double held_s = 0.2;
    const AssessState state = after_assessment({}, [&](double at_s, const AssessState& now, FingersTurn& turn) {
        if (!now.measures || assess_parts()[now.part].task != AssessTask::press) return;
        const double since_s = at_s - assess_begins_s(now.part) - 2.0;
        if (since_s > 0.0 && since_s < held_s) turn.drive_N[0] = 9.0;
    });
    EXPECT_NEAR(assessed(state).fingers[0].strength_N.value(), AssessedHand{}.holds_N[0], 1e-12);
}

TEST(Assessment, TellsNothingOfAFingerThatDoesNotMoveOrIsNotRead) {
    const Assessed still = assessed(after_assessment({}, [](double, const AssessState&, FingersTurn& turn) {
        turn.joints_rad[2] = devices::bent_in(GripShape::whole, 2, 0.0);
    }));
    EXPECT_FALSE(still.fingers[2].fractionation);
    EXPECT_TRUE(still.fingers[1].fractionation);
    EXPECT_EQ(still.fingers[2].range_rad[1], 0.0);
    EXPECT_EQ(still.measured_parts(), kAssessParts - 2) << "its speed, too";
    const Assessed unread =
        assessed(after_assessment({}, [](double, const AssessState&, FingersTurn& turn) { turn.has_fault[3] = true; }));
    EXPECT_FALSE(unread.fingers[3].strength_N);
    EXPECT_FALSE(unread.fingers[3].closed);
    EXPECT_FALSE(unread.closed) << "the mean would be of fewer fingers";
    EXPECT_FALSE(unread.together_N);
    EXPECT_NEAR(unread.fingers[0].strength_N.value(), AssessedHand{}.holds_N[0], 1e-12);
}

// The second press begins at 26 s; what is pressed in its first second is forgotten, and it begins anew after 3 s.
TEST(Assessment, BeginsAPartAnewThatABreakHasPutBack) {
    AssessState state;
    Nanoseconds now_ns = 1'000'000'000;
    const auto go_on = [&](double for_s, double each_N) {
        for (int i = 0; i < static_cast<int>(1000.0 * for_s + 0.5); ++i) {
            ExerciseTurn turn;
            turn.time_ns = now_ns += 1'000'000;
            turn.fingers.dt_s = kAssessTurn_s;
            for (auto& drive_N : turn.fingers.drive_N) drive_N = each_N;
            state = step_assessment(std::move(state), turn).state;
        }
    };
    go_on(24.0, 2.0);
    go_on(3.0, 6.0);
    ASSERT_NEAR(assessed(state).fingers[0].strength_N.value(), 6.0, 1e-12);
    const AssessStep broken = interrupted(state, now_ns);
    ASSERT_EQ(broken.events.size(), 1u);
    EXPECT_EQ(broken.events[0].what, kPartInterrupted);
    state = broken.state;
    EXPECT_NEAR(assessed(state).fingers[0].strength_N.value(), 2.0, 1e-12) << "the first press stays";
    EXPECT_NEAR(assessed(state).together_N.value(), 8.0, 1e-12);
    EXPECT_TRUE(interrupted(state, now_ns).events.empty()) << "nothing is measured";
    go_on(2.9, 0.0);
    EXPECT_FALSE(state.measures);
    go_on(0.2, 0.0);
    EXPECT_TRUE(state.measures);
    EXPECT_EQ(state.part, 2u);
    go_on(80.0, 0.0);
    EXPECT_EQ(state.end, ExerciseEnd::done);
    EXPECT_NEAR(state.time_s(), 94.0 + 1.0 + 3.0, 0.0025);
    EXPECT_NEAR(assessed(state).fingers[0].strength_N.value(), 2.0, 1e-12);
}

TEST(Assessment, IsNotBegunByPressesAndSaysHow) {
    const ExerciseKind& kind = *exercise_named("assess");
    SettingValues values(kind.settings);
    ASSERT_TRUE(values.set("start", "pressed"));
    const auto wrong = kind.conflict(values);
    ASSERT_TRUE(wrong);
    EXPECT_EQ(wrong->where, "start");
    EXPECT_TRUE(wrong->remedy.contains("asked"));
    ASSERT_TRUE(values.set("start", "asked"));
    EXPECT_FALSE(kind.conflict(values));
}

TEST(FingerCourses, AreReadAsTheyAreWrittenAndGoOnStraightLines) {
    const devices::FingerCourse course = assess_course_of(assessed_hand(SimulatedPerson::weak));
    const auto read = devices::parse_finger_course(devices::finger_course_text(course), "weak.fingers");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->holds_N, course.holds_N);
    ASSERT_EQ(read->rows.size(), course.rows.size());
    for (std::size_t i = 0; i < course.rows.size(); ++i) EXPECT_EQ(read->rows[i].closed, course.rows[i].closed);
    const auto line = devices::parse_finger_course("burin-fingers 1\n1.0 0 0 0 0\n3.0 1 0.5 0 0.2\n", "a.fingers");
    ASSERT_TRUE(line) << line.error().line();
    EXPECT_EQ(line->closed_at(0.0)[0], 0.0);
    EXPECT_DOUBLE_EQ(line->closed_at(2.0)[0], 0.5);
    EXPECT_DOUBLE_EQ(line->closed_at(2.5)[1], 0.375);
    EXPECT_EQ(line->closed_at(9.0)[3], 0.2);
    for (const char* wrong : {"", "nothing\n1 0 0 0 0\n", "burin-fingers 1\n", "burin-fingers 1\n1 0 0 0\n",
                              "burin-fingers 1\n1 0 0 0 0 0\n", "burin-fingers 1\n1 0 0 0 2\n",
                              "burin-fingers 1\n1 0 0 0 -1\n", "burin-fingers 1\n2 0 0 0 0\n1 0 0 0 0\n"})
        EXPECT_FALSE(devices::parse_finger_course(wrong, "a.fingers")) << wrong;
}

// Pressed against a spring it comes to rest where that gives what it holds, whatever the spring.
TEST(FingerCourses, PressWithTheForceThatAFingerHoldsAndNoMore) {
    devices::FingerCourse course;
    course.holds_N = {2.5, 0.0, 1.5, 0.7};
    course.rows = {{0.0, {}}, {1.0, {1.0, 1.0, 1.0, 1.0}}};
    for (const double spring_N : {15.0, 40.0}) {
        devices::Grip grip;
        devices::GloveForces pushed_N{};
        for (int i = 0; i < 4000; ++i) {
            grip = stepped(grip, course, i * kAssessTurn_s, pushed_N, kAssessTurn_s);
            for (std::size_t k = 0; k < pushed_N.size(); ++k)
                pushed_N[k] = spring_N * std::max(grip.closed[k] - 0.3, 0.0);
        }
        EXPECT_NEAR(pushed_N[0], 2.5, 1e-3);
        EXPECT_LT(pushed_N[1], 0.1);
        EXPECT_NEAR(pushed_N[2], 1.5, 1e-3);
        EXPECT_NEAR(pushed_N[3], 0.7, 1e-3);
    }
}

}  // namespace burin::activities
