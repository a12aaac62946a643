// SPDX-License-Identifier: MIT
// A PHANTOM Omni that is not there: the simulated Omni in a scripted hand, offered through shared memory to the
// emulated library of its maker (devices/emulators/hd_library/), which a session loads in place of the maker's. The
// script (circling_hand.hpp) begins when a session has opened it. A force that no library has renewed for
// kSharedForce_ns is none. One thread runs it; the drills may be set by any.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "devices/emulators/emulated_motion.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/presence/hd_shared.hpp"

namespace burin::devices {

struct EmulatedOmniOptions {
    // Of the hand, in the device frame, from when a session has opened it; empty: circling_hand().
    std::vector<HandPose> script;
    SilenceDrill silence;  // it stops stepping then, as a device whose cable is pulled
    // What its library says of it.
    std::string model = "PHANTOM Omni, emulated";
    double most_N = OmniModel{}.max_force_N;
};

class EmulatedOmni {
public:
    // Where the workspace's middle is in HDAPI's own frame, which begins elsewhere: metres.
    static constexpr Vec3 kMiddle_hd_m{0.0, 0.04, -0.02};

    // Fails where one of that name is there already.
    [[nodiscard]] static Result<EmulatedOmni> create(const std::string& name, EmulatedOmniOptions options = {});
    // Runs in real time until `ends` says so, which is asked a thousand times a second.
    void run(const std::function<bool()>& ends);

    // Drills.
    void fall_silent(bool is_silent) { drill_->is_silent = is_silent; }
    // Counts as dead only when it was kept from its steps for so long: tests run on machines that keep it long.
    void dies_after(Nanoseconds silence_ns) { memory_->dead_ns.store(silence_ns, std::memory_order_relaxed); }
    void lose_its_pose(bool is_nan) { drill_->is_nan = is_nan; }
    // Has the library report this error in every frame; 0: none.
    void raise(std::uint32_t error) { memory_->error.store(error, std::memory_order_relaxed); }
    // Is calibrated in another way than by its inkwell; by a reset of its encoders it needs a hand after it is switched
    // on, and a library that updates it while it stands in its reset position.
    void calibrate_by(std::uint32_t style) { memory_->styles.store(style, std::memory_order_relaxed); }
    void stand_at_reset(bool does) { memory_->is_at_reset.store(does ? 1 : 0, std::memory_order_relaxed); }
    // Has its library say this of its greatest force.
    void say_most(double force_N) { memory_->most_N.store(force_N, std::memory_order_relaxed); }
    // Has to be calibrated as HDAPI says it (devices/drivers/hd_api.hpp); a library that updates it makes it well.
    void need_calibration(std::uint32_t what) { memory_->calibration.store(what, std::memory_order_relaxed); }
    [[nodiscard]] std::uint32_t calibrations() const { return memory_->calibrations.load(std::memory_order_relaxed); }
    // Returns the force that was last written to it, newtons.
    [[nodiscard]] Vec3 written_N() const;

private:
    struct Drill {
        std::atomic<bool> is_silent = false, is_nan = false;
    };
    EmulatedOmni(HdSharedMemory memory, EmulatedOmniOptions options)
        : memory_(std::move(memory)), options_(std::move(options)) {}
    void publish(SimulatedOmni& omni, Nanoseconds now_ns);

    HdSharedMemory memory_;
    EmulatedOmniOptions options_;
    std::unique_ptr<Drill> drill_ = std::make_unique<Drill>();
};

}  // namespace burin::devices
