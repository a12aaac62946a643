// SPDX-License-Identifier: MIT
// A sample whose stamp is odd, though not so odd that it is refused: what it costs the hand at most, and that it is
// over again while the hand rests.
#include <gtest/gtest.h>

#include "devices/haptic/simulated_omni.hpp"
#include "haptics/tick.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics {

TEST(OddStamp, TakesNoForceFromAHandThatRests) {
    const test::Surface plane = test::plane();
    const devices::DeviceDescription omni =
        devices::SimulatedOmni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}})).description();
    TickParameters parameters;
    parameters.sequence = 1;
    parameters.probe = ball_probe(0.002);
    parameters.max_surface_age_s = 0.0;
    for (const Nanoseconds odd_ns :
         {-1'200'000'000, -150'000'000, -18'000'000, -2'000'000, -1'000'000, 500'000, 2'000'000, 4'000'000}) {
        FullTickState state;
        double before_N = 0.0, after_N = 0.0, most_N = 0.0;
        for (int i = 0; i < 600; ++i) {
            const Nanoseconds now_ns = 1'000'000'000 + 1'000'000 * i;
            devices::DeviceSample sample;
            sample.time_ns = now_ns + (i == 300 ? odd_ns : 0);
            sample.position_device_m.y = std::max(0.004 - 2e-5 * i, -0.001);
            const FullTick full = full_tick(state, sample, *plane, parameters, omni, now_ns, 1e-3);
            state = full.next;
            after_N = full.record.gate.given.force_device_N.y;
            if (i < 300) before_N = after_N;
            most_N = std::max(most_N, after_N);
        }
        EXPECT_GT(before_N, 1.2);
        EXPECT_NEAR(after_N, before_N, 0.02 * before_N) << odd_ns;
        EXPECT_LE(most_N, 1.05 * before_N) << odd_ns;
    }
}

}  // namespace burin::haptics
