// SPDX-License-Identifier: MIT
// Ten thousand ticks of an Omni in a steered hand, with targets coming and going: not one allocation, lock, throw or
// file.
#include <gtest/gtest.h>

#include <cmath>

#include "devices/haptic/simulated_omni.hpp"
#include "tests/support/realtime_counters.hpp"

namespace burin::devices {

TEST(SteeredHand, AllocatesLocksThrowsAndOpensNothingInTenThousandTicks) {
    HandSteering channel;
    SimulatedOmni omni(*SteeredHand::create(&channel));
    test::RealtimeCounts counts;
    {
        const test::RealtimeScope scope;
        for (int i = 0; i < 10000; ++i) {
            if (i % 16 == 0) {  // leaps, rests and nonsense
                const double x = i % 160 == 0 ? NAN : 0.08 * std::sin(0.1 * i);
                static_cast<void>(channel.push({i * 1'000'000, {x, 0.0, 0.0}, {1, 0, 0, 0}, 1}));
            }
            omni.advance(1'000'000);
            static_cast<void>(omni.read());
            omni.write({});
        }
        counts = scope.counts();
    }
    EXPECT_EQ(counts.allocations, 0u);
    EXPECT_EQ(counts.frees, 0u);
    EXPECT_EQ(counts.locks, 0u);
    EXPECT_EQ(counts.throws, 0u);
    EXPECT_EQ(counts.files, 0u);
    EXPECT_GT(omni.time_ns(), 9'999'000'000);  // it did move on
}

}  // namespace burin::devices
