// SPDX-License-Identifier: MIT
// A Quanser wand that is not there: the simulated wand in a scripted hand, with encoders and motors as the maker's
// description has them, offered through shared memory to the emulated library of its maker
// (devices/emulators/hil_library/), which a session loads in place of the maker's. Between two sessions the handle
// rests in its jig; when one has opened it, the hand goes out to the workspace's middle, circles there and nods.
// A card holds its volts until others are written, or until its watchdog takes them off. They do nothing while the
// amplifiers are off. One thread runs it; the drills may be set by any.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "devices/emulators/emulated_motion.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "devices/presence/hil_shared.hpp"

namespace burin::devices {

struct EmulatedWandOptions {
    // Of the hand, in the device frame, from when a session has opened it; it should begin in the jig. Empty: as above.
    std::vector<HandPose> script;
    SilenceDrill silence;  // the card is gone then
};

class EmulatedWand {
public:
    static constexpr double kScript_s = 3600.0;  // beyond it the hand rests

    // Fails where one of that name is there already.
    [[nodiscard]] static Result<EmulatedWand> create(const std::string& name, EmulatedWandOptions options = {});
    // Runs in real time until `ends` says so, which is asked a thousand times a second.
    void run(const std::function<bool()>& ends);

    // Drills.
    void fall_silent(bool is_silent) { drill_->is_silent = is_silent; }
    // Counts as dead only when it was kept from its steps for so long: tests run on machines that keep it long.
    void dies_after(Nanoseconds silence_ns) { memory_->dead_ns.store(silence_ns, std::memory_order_relaxed); }
    // Has every function of the library return this error; 0: none.
    void raise(std::int32_t error) { memory_->error.store(error, std::memory_order_relaxed); }
    void miscount(double counts) { drill_->miscount = counts; }  // of the first encoder
    // Sets the counters back, as a card does that has lost its power.
    void lose_counts();
    // Returns the volts at its outputs: those that were last written, or none where the watchdog has taken them off.
    [[nodiscard]] WandJoints volts() const;
    [[nodiscard]] bool are_amplifiers_on() const { return memory_->enabled.load(std::memory_order_relaxed) == 0x3f; }
    // What acts at the handle, by the motors' torques; device frame. The newest step's.
    [[nodiscard]] DeviceWrench acting() const;
    [[nodiscard]] bool has_tripped() const { return drill_->has_tripped; }
    [[nodiscard]] static WandDescription wand() { return quanser_wand_of_maker(); }

private:
    struct Drill {
        std::atomic<bool> is_silent = false, has_tripped = false;
        std::atomic<double> miscount = 0.0;
        SharedNumbers<6> acting;
    };
    EmulatedWand(HilSharedMemory memory, EmulatedWandOptions options)
        : memory_(std::move(memory)), options_(std::move(options)) {}
    [[nodiscard]] DeviceWrench wrench_of_volts(const Pose& device_from_handle) const;
    void publish(const Pose& device_from_handle, Nanoseconds now_ns);

    HilSharedMemory memory_;
    EmulatedWandOptions options_;
    WandDescription wand_ = wand();
    std::unique_ptr<Drill> drill_ = std::make_unique<Drill>();
};

}  // namespace burin::devices
