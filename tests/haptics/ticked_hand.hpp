// SPDX-License-Identifier: MIT
// Whole ticks of a device on a surface, each a millisecond after the last, with the hand where the test puts it.
#pragma once

#include "haptics/tick.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics::test {

struct TickedHand {
    geometry::LocalSurface surface;
    TickParameters parameters;
    FullTickState state{};
    TickRecord record{};
    Nanoseconds now_ns = 1'000'000'000;

    const TickRecord& tick(const Vec3& hand_m) {
        now_ns += 1'000'000;
        devices::DeviceSample sample;
        sample.time_ns = now_ns;
        sample.position_device_m = hand_m;
        const FullTick full = full_tick(state, sample, surface, parameters, kStrongDevice, now_ns, 1e-3);
        state = full.next;
        return record = full.record;
    }
};

}  // namespace burin::haptics::test
