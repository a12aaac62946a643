// SPDX-License-Identifier: MIT
// The steps of an emulated arm in real time, a thousand a second: what its library has written last acts on it, as long
// as that is renewed, and what it does is published. One thread, of the priority of a servo where that is granted: no
// program keeps a real device from its steps.
#pragma once

#include <algorithm>
#include <functional>

#include "base/clock.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/shared_memory.hpp"
#include "devices/served/served_arm.hpp"

namespace burin::devices {

struct EmulatedArmSteps {
    std::function<bool()> ends;
    std::function<bool(double time_s)> is_silent;  // since it runs: its cable is pulled, and it does not step
    std::function<Vec3()> written_N;               // device frame; not finite: it could not be read, and stays
    std::function<void(Nanoseconds now_ns)> publish;
    // Returns for how long a force is held that the library does not renew; empty: kSharedForce_ns.
    std::function<Nanoseconds()> holds_ns = {};
};

// Shared is a SharedLife with the time of the library's newest frame, frame_ns. Before a library has had one the hand's
// time stands.
template <typename Shared>
void run_emulated_arm(Shared& shared, SimulatedOmni& arm, const EmulatedArmSteps& steps) {
    static_cast<void>(ask_for_servo_priority());
    constexpr Nanoseconds kPeriod_ns = 1'000'000;
    MonotonicClock clock;
    const Nanoseconds begun_ns = clock.now_ns();
    Nanoseconds due_ns = begun_ns;
    while (!steps.ends()) {
        due_ns = std::max(due_ns + kPeriod_ns, clock.now_ns() - 50 * kPeriod_ns);
        clock.sleep_until(due_ns);
        const Nanoseconds now_ns = clock.now_ns();
        if (steps.is_silent(seconds(now_ns - begun_ns))) {
            shared.pull_cable();
            continue;
        }
        const Nanoseconds frame_ns = shared.frame_ns.load(std::memory_order_relaxed);
        const Nanoseconds holds_ns = steps.holds_ns ? steps.holds_ns() : kSharedForce_ns;
        const bool is_heard = frame_ns > 0 && now_ns - frame_ns < holds_ns;
        const Vec3 force_N = is_heard ? steps.written_N() : Vec3(0.0);
        if (finite(force_N)) arm.write({force_N, Vec3(0.0)});
        if (frame_ns > 0) arm.advance(kPeriod_ns);
        steps.publish(now_ns);
    }
    shared.pull_cable();
}

}  // namespace burin::devices
