// SPDX-License-Identifier: MIT
// A Force Dimension omega.3 that is not there: a simulated arm in a scripted hand, offered through shared memory to the
// emulated library of its maker (devices/emulators/dhd_library/), which a session loads in place of the maker's. The
// script begins when a session has opened it. It holds a force that is not renewed until its watchdog ends, and without
// a watchdog for ever. Unlike a real one it does not wait for its button then: a busy machine would press it in vain.
// One thread runs it; the drills may be set by any.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "devices/emulators/emulated_motion.hpp"
#include "devices/hand/simulated_hand.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/dhd_shared.hpp"

namespace burin::devices {

struct EmulatedDhdOptions {
    std::vector<HandPose> script;  // of the hand, device frame; empty: circling_hand()
    SilenceDrill silence;          // it stops stepping then, as a device whose cable is pulled
    int type = 33;                 // as dhdGetSystemType says it: an omega.3, whose handle does not turn
};

class EmulatedDhd {
public:
    // Fails where one of that name is there already.
    [[nodiscard]] static Result<EmulatedDhd> create(const std::string& name, EmulatedDhdOptions options = {});
    // Runs in real time until `ends` says so, which is asked a thousand times a second.
    void run(const std::function<bool()>& ends);

    // Drills.
    void fall_silent(bool is_silent) { drill_->is_silent = is_silent; }
    // Counts as dead only when it was kept from its steps for so long: tests run on machines that keep it long.
    void dies_after(Nanoseconds silence_ns) { memory_->dead_ns.store(silence_ns, std::memory_order_relaxed); }
    void lose_its_pose(bool is_nan) { drill_->is_nan = is_nan; }
    // Switches its force off, for a reason as DHD numbers them; 0: on again.
    void switch_force_off(std::int32_t why) { memory_->force_off.store(why, std::memory_order_relaxed); }
    void need_reset(bool needs) { memory_->needs_reset.store(needs ? 1 : 0, std::memory_order_relaxed); }
    // Returns the force that was last written to it, newtons, device frame.
    [[nodiscard]] Vec3 written_N() const;
    [[nodiscard]] std::uint32_t watchdog() const { return memory_->watchdog.load(std::memory_order_relaxed); }

private:
    struct Drill {
        std::atomic<bool> is_silent = false, is_nan = false;
    };
    EmulatedDhd(DhdSharedMemory memory, EmulatedDhdOptions options)
        : memory_(std::move(memory)), options_(std::move(options)) {}
    void publish(SimulatedOmni& arm, Nanoseconds now_ns);

    DhdSharedMemory memory_;
    EmulatedDhdOptions options_;
    std::unique_ptr<Drill> drill_ = std::make_unique<Drill>();
};

}  // namespace burin::devices
