// SPDX-License-Identifier: MIT
#include "base/clock.hpp"

#include <gtest/gtest.h>

namespace burin {

TEST(Clock, SimulatedTimeMovesOnlyWhenSomeoneSleeps) {
    SimulatedClock clock;
    EXPECT_EQ(clock.now_ns(), 0);
    clock.sleep_until(1'000'000);
    EXPECT_EQ(clock.now_ns(), 1'000'000);
    clock.sleep_until(500);  // past: no way back
    EXPECT_EQ(clock.now_ns(), 1'000'000);
}

TEST(Clock, MonotonicNeverReturnsBeforeItsDeadline) {
    MonotonicClock clock;
    for (int i = 0; i < 20; ++i) {
        const Nanoseconds deadline_ns = clock.now_ns() + 200'000;
        clock.sleep_until(deadline_ns);
        EXPECT_GE(clock.now_ns(), deadline_ns);
    }
}

TEST(Clock, SecondsAndNanosecondsRoundTrip) {
    EXPECT_EQ(nanoseconds(0.001), 1'000'000);
    EXPECT_EQ(nanoseconds(-0.001), -1'000'000);
    EXPECT_DOUBLE_EQ(seconds(1'500'000'000), 1.5);
}

}  // namespace burin
