// SPDX-License-Identifier: MIT
// Targets whose times do not rise: what comes after them is at its own time again.
#include <gtest/gtest.h>

#include <algorithm>

#include "devices/hand/steered_hand.hpp"
#include "tests/support/test_units.hpp"

namespace burin::devices {
namespace {

void tell(HandSteering& channel, double x_m, Nanoseconds time_ns) {
    ASSERT_TRUE(channel.push({time_ns, {x_m, 0.0, 0.0}, {1, 0, 0, 0}, 0}));
}

}  // namespace

// A target 16 ms after the other; each fourth has a time before that of the one that came before it.
TEST(SteeredHand, TargetsThatWereOvertakenDelayNoneAfterThem) {
    HandSteering channel;
    SteeredHand hand = *SteeredHand::create(&channel);
    double farthest_behind_m = 0.0;
    for (int t = 0; t < 3000; ++t) {
        const int i = t / 16;
        if (t % 16 == 0) tell(channel, 1e-6 * t, (16 * i - (i % 4 == 3 ? 20 : 0)) * kMs);
        farthest_behind_m = std::max(farthest_behind_m, 1e-6 * t - hand.target(1e-3 * t).position_device_m.x);
    }
    // The target after an overtaken one needs two intervals, and the hand's lag is 4 ms; the rest is its steps.
    EXPECT_LT(farthest_behind_m, 1e-6 * (2 * 16 + 4 + 1));
}

// At 0.1 m/s but for the fiftieth of it by which a goal speeds up or slows down.
TEST(SteeredHand, MovesEvenlyAgainAfterItsSourcesClockWasSetBack) {
    HandSteering channel;
    SteeredHand hand = *SteeredHand::create(&channel);
    double before_m = 0.0;
    for (int t = 0; t < 3000; ++t) {
        if (t % 16 == 0) tell(channel, 1e-4 * t, (t - (t > 800 ? 30'000 : 0)) * kMs);
        const double x = hand.target(1e-3 * t).position_device_m.x;
        if (t > 1500) {
            EXPECT_NEAR(x - before_m, 1e-4, 0.03 * 1e-4) << t;
        }
        before_m = x;
    }
}

}  // namespace burin::devices
