// SPDX-License-Identifier: MIT
// Measures of a hand, finger by finger and joint by joint: what one does alone is told of it alone, and what is no
// flexion is none.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "activities/rehab/measures/hand_measures.hpp"

namespace burin::activities {
namespace {

constexpr std::size_t kMeasuredFingers = devices::kGloveFingers, kJoints = devices::kFingerJoints;
using JointWays = std::array<double, kJoints>;  // how far each goes, radians

// A hand that goes on from wherever it is; each finger rests at other angles.
class MeasuredHand {
public:
    MeasuredHand() {
        for (std::size_t finger = 0; finger < kMeasuredFingers; ++finger)
            for (std::size_t joint = 0; joint < kJoints; ++joint)
                turn_.joints_rad[finger][joint] =
                    0.1 + 0.03 * static_cast<double>(finger) - 0.07 * static_cast<double>(joint);
        turn_.dt_s = 0.001;
        go(1, 0, {});
        go(kRests_ms, 0, {});
    }
    // Has a finger go so far, evenly over so many milliseconds.
    void go(int turns, std::size_t finger, const JointWays& ways_rad) {
        for (int i = 0; i < turns; ++i) {
            for (std::size_t joint = 0; joint < kJoints; ++joint)
                turn_.joints_rad[finger][joint] += ways_rad[joint] / turns;
            measures = with_turn(measures, turn_);
        }
    }
    // As the device reads a finger by mistake, or loses it: so many milliseconds of such angles.
    void misread(int turns, std::size_t finger, double off_rad) {
        turn_.has_fault[finger] = true;
        for (double& angle_rad : turn_.joints_rad[finger]) angle_rad += off_rad;
        for (int i = 0; i < turns; ++i) measures = with_turn(measures, turn_);
        for (double& angle_rad : turn_.joints_rad[finger]) angle_rad -= off_rad;
        turn_.has_fault[finger] = false;
    }
    // Has a finger stand elsewhere after a gap.
    void jump(double gap_s, std::size_t finger, double off_rad) {
        for (double& angle_rad : turn_.joints_rad[finger]) angle_rad += off_rad;
        turn_.dt_s = gap_s;
        measures = with_turn(measures, turn_);
        turn_.dt_s = 0.001;
    }
    // Has the device measure what a finger's piston gives.
    void measure(std::size_t finger, std::optional<double> force_N) { turn_.measured_N[finger] = force_N; }
    void push(int turns, std::size_t finger, double force_N) {
        turn_.forces_N[finger] = force_N;
        for (int i = 0; i < turns; ++i) measures = with_turn(measures, turn_);
        turn_.forces_N = {};
    }
    HandMeasures measures;
    static constexpr int kRests_ms = 100;  // longer than a range's ends are held; two windows

private:
    FingersTurn turn_;
};

struct Motion {
    const char* of;
    JointWays ways_rad;
};
// Which motions there are, and the flexion of each: the sum of the three joints that bend, not of the one that goes
// sideways.
constexpr Motion kMotions[]{
    {"sideways", {0.5, 0.0, 0.0, 0.0}},
    {"sideways back", {-0.5, 0.0, 0.0, 0.0}},
    {"bends in the first", {0.0, 0.6, 0.0, 0.0}},
    {"bends in the second", {0.0, 0.0, 0.7, 0.0}},
    {"bends in the third", {0.0, 0.0, 0.0, 0.8}},
    {"opens in the first", {0.0, -0.65, 0.0, 0.0}},
    {"opens in the second", {0.0, 0.0, -0.75, 0.0}},
    {"opens in the third", {0.0, 0.0, 0.0, -0.85}},
    {"bends in all", {0.0, 0.3, 0.4, 0.5}},
    {"bends and goes sideways", {0.9, 0.3, 0.2, 0.1}},
    {"bends as much as it opens", {0.0, 0.6, -0.6, 0.0}},
};
double flexion_rad(const Motion& motion) { return motion.ways_rad[1] + motion.ways_rad[2] + motion.ways_rad[3]; }

std::string of(const Motion& motion, std::size_t finger) { return std::string(kFingerNames[finger]) + " " + motion.of; }

}  // namespace

TEST(EachFinger, ThatMovesAloneIsMeasuredAlone) {
    constexpr int kMoves_ms = 500;  // ten windows
    for (std::size_t finger = 0; finger < kMeasuredFingers; ++finger)
        for (const Motion& motion : kMotions) {
            MeasuredHand hand;
            hand.go(kMoves_ms, finger, motion.ways_rad);
            hand.go(kMoves_ms, finger, {});
            const double way_rad = std::abs(flexion_rad(motion)), took_s = 1e-3 * kMoves_ms;
            for (std::size_t other = 0; other < kMeasuredFingers; ++other) {
                const FingerMeasures& is = hand.measures.fingers[other];
                const double own_rad = other == finger ? way_rad : 0.0;
                const bool moves = own_rad > 1e-6;
                EXPECT_NEAR(is.moved_rad, own_rad, 1e-9) << of(motion, finger) << ", told of " << kFingerNames[other];
                EXPECT_NEAR(is.moved_s, moves ? took_s : 0.0, 1e-9) << of(motion, finger);
                EXPECT_NEAR(is.peak_rad_per_s, own_rad / took_s, 1e-6) << of(motion, finger);
                EXPECT_NEAR(is.mean_rad_per_s(), own_rad / took_s, 1e-6) << of(motion, finger);
                EXPECT_NEAR(is.led_rad, own_rad, 1e-9) << of(motion, finger);
                EXPECT_NEAR(is.followed_rad, 0.0, 1e-9) << of(motion, finger);
                EXPECT_EQ(is.fractionation().has_value(), own_rad >= FingerMeasures::kLed_rad) << of(motion, finger);
                if (is.fractionation()) {
                    EXPECT_NEAR(*is.fractionation(), 1.0, 1e-9) << of(motion, finger);
                }
                for (std::size_t joint = 0; joint < kJoints; ++joint)
                    EXPECT_NEAR(is.range_rad(joint), other == finger ? std::abs(motion.ways_rad[joint]) : 0.0, 1e-9)
                        << of(motion, finger) << ", joint " << joint;
                EXPECT_EQ(is.peak_N, 0.0);
                EXPECT_EQ(is.pushed_s, 0.0);
            }
        }
}

TEST(EachFinger, ThatLeadsIsToldApartFromTheOneThatFollows) {
    for (std::size_t leads = 0; leads < kMeasuredFingers; ++leads)
        for (std::size_t follows = 0; follows < kMeasuredFingers; ++follows) {
            if (leads == follows) continue;
            // One goes half as far as the other: it does not lead, and the mean is that of three others.
            MeasuredHand both;
            for (int i = 0; i < 500; ++i) both.go(1, i % 2 == 0 ? leads : follows, {0.0, i % 2 == 0 ? 0.008 : 0.004});
            const FingerMeasures& first = both.measures.fingers[leads];
            EXPECT_NEAR(*first.fractionation(), 1.0 - 0.5 / 3.0, 1e-9) << leads << " and " << follows;
            EXPECT_NEAR(first.moved_rad, 2.0, 1e-9);
            EXPECT_NEAR(both.measures.fingers[follows].moved_rad, 1.0, 1e-9);
            EXPECT_FALSE(both.measures.fingers[follows].fractionation());
        }
}

TEST(EachFinger, ThatIsPushedHasItsOwnForces) {
    for (std::size_t finger = 0; finger < kMeasuredFingers; ++finger) {
        MeasuredHand hand;
        hand.push(200, finger, 3.0);
        hand.push(100, finger, 1.5);
        hand.push(100, finger, 0.5 * FingerMeasures::kPushed_N);
        for (std::size_t other = 0; other < kMeasuredFingers; ++other) {
            const FingerMeasures& is = hand.measures.fingers[other];
            const double own = other == finger ? 1.0 : 0.0;
            EXPECT_NEAR(is.peak_N, 3.0 * own, 1e-12) << finger << other;
            EXPECT_NEAR(is.pushed_s, 0.3 * own, 1e-9) << finger << other;
            EXPECT_NEAR(is.impulse_Ns, 0.75 * own, 1e-9) << finger << other;
            EXPECT_NEAR(is.mean_N(), 2.5 * own, 1e-9) << finger << other;
            EXPECT_EQ(is.moved_rad, 0.0);
        }
    }
}

TEST(EachFinger, ThatIsReadByMistakeOrLostHasNotMoved) {
    for (std::size_t finger = 0; finger < kMeasuredFingers; ++finger) {
        MeasuredHand hand;
        hand.push(200, finger, 2.0);
        const FingerMeasures before = hand.measures.fingers[finger];
        for (const double off_rad : {0.8, -1.4, 2.5}) hand.misread(137, finger, off_rad);
        hand.go(200, finger, {});
        const FingerMeasures& is = hand.measures.fingers[finger];
        EXPECT_EQ(is.moved_rad, 0.0) << finger;
        EXPECT_EQ(is.peak_rad_per_s, 0.0) << finger;
        EXPECT_EQ(is.impulse_Ns, before.impulse_Ns) << finger;
        for (std::size_t joint = 0; joint < kJoints; ++joint)
            EXPECT_NEAR(is.range_rad(joint), 0.0, 1e-12) << finger << joint;
        // Another finger that moves meanwhile does, but whether it led nobody knows.
        const std::size_t other = (finger + 1) % kMeasuredFingers;
        MeasuredHand two;
        for (int i = 0; i < 500; ++i) {
            two.misread(1, finger, 0.3 * (i % 2));
            two.go(1, other, {0.0, 0.002});
        }
        EXPECT_NEAR(two.measures.fingers[other].moved_rad, 1.0, 0.01);
        EXPECT_EQ(two.measures.fingers[other].led_rad, 0.0);
        // After a gap it is elsewhere: that is a range, and no speed.
        hand.jump(0.3, finger, 0.7);
        hand.go(200, finger, {});
        EXPECT_EQ(hand.measures.fingers[finger].peak_rad_per_s, 0.0) << finger;
        for (std::size_t joint = 0; joint < kJoints; ++joint)
            EXPECT_NEAR(hand.measures.fingers[finger].range_rad(joint), 0.7, 1e-9) << finger << joint;
    }
}

// A reading may be off and yet plausible; a joint's range has ends at which it has stayed.
TEST(EachFinger, ThatIsElsewhereForAMomentHasNoWiderRange) {
    for (const auto& [stays_ms, range_rad] : {std::pair{20, 0.0}, {45, 0.0}, {75, 0.4}, {200, 0.4}}) {
        MeasuredHand hand;
        for (int times = 0; times < 20; ++times) {
            hand.go(1, 2, {0.0, 0.4});
            hand.go(stays_ms - 1, 2, {});
            hand.go(1, 2, {0.0, -0.4});
            hand.go(107, 2, {});
        }
        EXPECT_NEAR(hand.measures.fingers[2].range_rad(1), range_rad, 1e-9) << stays_ms;
        EXPECT_EQ(hand.measures.fingers[1].range_rad(1), 0.0);
    }
}

TEST(EachFinger, HasBesideTheForceThatItWasToldTheOneThatWasMeasured) {
    for (std::size_t finger = 0; finger < kMeasuredFingers; ++finger) {
        MeasuredHand hand;
        hand.push(100, finger, 3.0);
        EXPECT_FALSE(hand.measures.fingers[finger].mean_measured_N());
        hand.measure(finger, 1.0);
        hand.push(100, finger, 3.0);
        hand.measure(finger, 2.0);
        hand.push(300, finger, 4.0);
        for (std::size_t other = 0; other < kMeasuredFingers; ++other) {
            const FingerMeasures& is = hand.measures.fingers[other];
            EXPECT_EQ(is.mean_measured_N().has_value(), other == finger) << finger << other;
            EXPECT_EQ(is.measured_peak_N, other == finger ? 2.0 : 0.0) << finger << other;
            if (other != finger) continue;
            EXPECT_NEAR(*is.mean_measured_N(), 1.75, 1e-9);
            EXPECT_NEAR(is.mean_N(), 3.6, 1e-9);
        }
    }
}

// Moves the fingers one after the other: the measures of those that rest do not change.
TEST(EachFinger, KeepsItsMeasuresWhileTheOthersGoOn) {
    MeasuredHand hand;
    for (std::size_t finger = 0; finger < kMeasuredFingers; ++finger) {
        const HandMeasures before = hand.measures;
        hand.go(500, finger, {0.2, 0.4, 0.3, 0.1});
        hand.push(50, finger, 1.0);
        hand.push(100, finger, 0.0);  // its free way begins anew
        for (std::size_t other = 0; other < kMeasuredFingers; ++other)
            EXPECT_EQ(hand.measures.fingers[other] == before.fingers[other], other != finger) << finger << other;
    }
}

}  // namespace burin::activities
