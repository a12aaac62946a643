// SPDX-License-Identifier: MIT
// A whole haptic session in simulated time: a simulated Omni in a scripted hand, a loop, channels, and a surface.
#pragma once

#include <vector>

#include "devices/haptic/simulated_omni.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics::test {

struct Rig {
    SimulatedClock clock;
    HapticChannels channels{1u << 12, 1u << 12};
    devices::SimulatedOmni omni;
    HapticLoop loop;

    explicit Rig(std::vector<devices::HandPose> script, devices::HandGrip grip = {}, devices::OmniModel model = {})
        : omni(*devices::SimulatedHand::create(std::move(script), devices::HandPath::straight, grip), model, &clock),
          loop(omni, clock, channels) {}

    // As the carving side does: fill the draft, publish.
    void publish(const geometry::LocalSurface& surface, std::uint64_t sequence) {
        geometry::LocalSurface& draft = channels.surface.draft();
        draft = surface;
        draft.sequence = sequence;
        draft.made_ns = clock.now_ns();
        channels.surface.publish();
    }
    void publish(TickParameters parameters, std::uint64_t sequence) {
        parameters.sequence = sequence;
        channels.parameters.draft() = parameters;
        channels.parameters.publish();
    }
    TickRecord tick() {
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        return loop.step();
    }
    std::vector<TickRecord> ticks(int count) {
        std::vector<TickRecord> all;
        for (int i = 0; i < count; ++i) all.push_back(tick());
        return all;
    }
};

}  // namespace burin::haptics::test
