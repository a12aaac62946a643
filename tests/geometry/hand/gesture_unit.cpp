// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "geometry/hand/gesture.hpp"
#include "tests/geometry/hand/hand_samples.hpp"

namespace burin::geometry {
namespace {

constexpr std::uint64_t kBall = 4;
constexpr Nanoseconds kSet_ns = 8'333'333;

GestureInput input_at(Nanoseconds time_ns, double closed, std::array<bool, kHandFingers> touches) {
    GestureInput input{.time_ns = time_ns};
    for (std::size_t i = 0; i < kHandFingers; ++i) {
        input.closures[i] = closed;
        input.touched[i] = touches[i] ? kBall : 0;
    }
    return input;
}

TEST(Gesture, G10BeginsWithContactOfTwoFingersAlone) {
    EXPECT_FALSE(step_gesture({}, input_at(1, 0.9, {})).grasps());
    EXPECT_FALSE(step_gesture({}, input_at(1, 0.9, {true})).grasps());
    EXPECT_FALSE(step_gesture({}, input_at(1, 0.0, {true, true, true, true})).grasps());
    const GestureState grasp = step_gesture({}, input_at(1, 0.3, {true, false, true, true}));
    EXPECT_EQ(grasp.gesture, Gesture::whole);
    EXPECT_EQ(grasp.object, kBall);
}

TEST(Gesture, G10IsAPinchOfThumbAndIndexAlone) {
    const GestureState pinch = step_gesture({}, input_at(1, 0.3, {true, true}));
    EXPECT_EQ(pinch.gesture, Gesture::pinch);
    EXPECT_EQ(step_gesture(pinch, input_at(2, 0.3, {true, true, true})).gesture, Gesture::whole);
}

TEST(Gesture, G10OfTwoObjectsAtOnceIsNoGrasp) {
    GestureInput input = input_at(1, 0.3, {true, true});
    input.touched[1] = kBall + 1;
    EXPECT_FALSE(step_gesture({}, input).grasps());
}

TEST(Gesture, G10PointsWithItsIndexStraight) {
    GestureInput input = input_at(1, 0.8, {});
    input.closures[1] = 0.05;
    const GestureState pointing = step_gesture({}, input);
    EXPECT_EQ(pointing.gesture, Gesture::point);
    input.time_ns = 2;
    input.closures[1] = 0.24;  // beyond where it begins, within where it goes on
    EXPECT_EQ(step_gesture(pointing, input).gesture, Gesture::point);
    EXPECT_EQ(step_gesture({}, input).gesture, Gesture::none);
}

TEST(Gesture, G10EndsWhenTheFingersHaveOpenedForATime) {
    GestureState state = step_gesture({}, input_at(1, 0.4, {true, true, true}));
    Nanoseconds time_ns = 1;
    const auto open_for = [&](Nanoseconds for_ns) {
        for (const Nanoseconds end_ns = time_ns + for_ns; time_ns < end_ns;) {
            time_ns += kSet_ns;
            state = step_gesture(state, input_at(time_ns, 0.2, {}));
        }
    };
    open_for(50'000'000);
    EXPECT_TRUE(state.grasps());
    time_ns += kSet_ns;
    state = step_gesture(state, input_at(time_ns, 0.4, {true, true, true}));  // has thought better of it
    open_for(50'000'000);
    EXPECT_TRUE(state.grasps());
    open_for(60'000'000);
    EXPECT_FALSE(state.grasps());
}

TEST(Gesture, G10OutlivesAGapOfATenthOfASecondAndNoLongerOne) {
    const GestureState grasp = step_gesture({}, input_at(1'000, 0.4, {true, true, true}));
    EXPECT_TRUE(step_gesture(grasp, input_at(1'000 + kMostGap_ns, 0.2, {})).grasps());
    EXPECT_FALSE(step_gesture(grasp, input_at(1'001 + kMostGap_ns, 0.2, {})).grasps());
}

// A hand that closes around a ball as far as the ball lets it, in sets of noisy joints.
class NoisyHand {
public:
    explicit NoisyHand(unsigned seed) : random_(seed) {
        std::uniform_real_distribution<double> radius(0.028, 0.04);
        radius_m_ = radius(random_);
        // In front of the palm, where the fingers close.
        center_m_ = {hand().is_left ? 0.01 : -0.01, 0.055, -0.012 - radius_m_};
    }

    // Closes or opens towards `wanted` of the way to a fist, one set; returns whether the fingers touch.
    GestureInput set(double wanted, bool has_ball) {
        time_ns_ += kSet_ns;
        closing_ += std::clamp(wanted - closing_, -0.02, 0.02);
        GestureInput input{.time_ns = time_ns_};
        std::normal_distribution<double> noise(0.0, std::numbers::pi / 180.0);
        for (const Finger finger : kAllFingers) {
            const auto i = static_cast<std::size_t>(finger);
            const FingerBend meant = bend_of(finger, closing_);
            // Where the ball holds the finger up, it stays; it goes on into it by a little, as a spring does.
            if (has_ball && depth_m(finger, meant) > kInto_m && closing_ > reached_[i]) {
                // held
            } else {
                reached_[i] = closing_;
            }
            FingerBend read = bend_of(finger, std::min(reached_[i], closing_));
            for (double& angle : read) angle += noise(random_);
            input.closures[i] = closure_of(finger, read);
            input.touched[i] = has_ball && depth_m(finger, read) > 0.0 ? kBall : 0;
        }
        return input;
    }
    [[nodiscard]] std::mt19937& random() { return random_; }

private:
    static constexpr double kInto_m = 0.003, kFingertip_m = 0.007;
    static const HandModel& hand() {
        static const HandModel model = hand_of("right");
        return model;
    }
    static FingerBend bend_of(Finger finger, double closing) {
        if (finger == Finger::thumb) return {-0.3 * closing, 0.7 * closing, 0.5 * closing, 0.6 * closing};
        return {0.0, 1.3 * closing, 1.5 * closing, 0.9 * closing};
    }
    [[nodiscard]] double depth_m(Finger finger, const FingerBend& bend) const {
        const Pose tip = hand_from_tip(hand(), finger, bend);
        return radius_m_ + kFingertip_m - glm::length(tip.position_m - center_m_);
    }

    std::mt19937 random_;
    Nanoseconds time_ns_ = 1;
    double closing_ = 0.0, radius_m_ = 0.0;
    std::array<double, kHandFingers> reached_{};
    Vec3 center_m_{0.0};
};

TEST(Gesture, G10LosesAndInventsNoneOfTenThousandNoisyGrasps) {
    constexpr unsigned kTrials = 10'000;
    unsigned lost = 0, invented = 0, grasps = 0;
    for (unsigned trial = 0; trial < kTrials; ++trial) {
        NoisyHand hand(trial);
        const bool has_ball = trial % 4 != 0;  // every fourth hand closes on nothing
        std::uniform_int_distribution<int> sets(40, 120);
        GestureState state;
        unsigned begun = 0;
        const auto go_on = [&](double wanted, int count) {
            for (int i = 0; i < count; ++i) {
                const bool held = state.grasps();
                state = step_gesture(state, hand.set(wanted, has_ball));
                if (!held && state.grasps()) ++begun;
            }
        };
        go_on(0.0, 10);
        if (state.grasps()) ++invented;
        go_on(0.9, 50);
        const bool took = state.grasps();
        go_on(0.9, sets(hand.random()));
        const bool kept = state.grasps() && begun == 1;
        go_on(0.0, 80);
        const bool let_go = !state.grasps();
        grasps += has_ball ? 1 : 0;
        if (has_ball && !(took && kept && let_go)) ++lost;
        if (begun > (has_ball ? 1u : 0u)) ++invented;
    }
    EXPECT_EQ(grasps, 7'500u);
    EXPECT_EQ(lost, 0u);
    EXPECT_EQ(invented, 0u);
}

}  // namespace
}  // namespace burin::geometry
