// SPDX-License-Identifier: MIT
// A SpaceMouse that is not there, at the far end of a socket (devices/presence/emulator_socket.hpp): it sends the HID
// reports of a device with its turn apart or together, each 8 ms while its cap is pushed, one of rest, and then none.
// The script begins when a host has come. One thread runs it; drills are any thread's.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "devices/emulators/emulated_motion.hpp"
#include "devices/emulators/spacemouse_wire.hpp"
#include "devices/presence/owned_file.hpp"

namespace burin::devices {

// Deflection of the cap, -1 to 1 along and about each axis of the device frame, and buttons: bit 0 is the first.
struct CapStand {
    Vec3 push{0.0}, turn{0.0};
    std::uint32_t buttons = 0;
};

// The usual script: rests, presses the cap away, circles with the first button down while it turns to and fro, and
// pulls it back, over 12 seconds. The hand that it leads comes back to where it was.
[[nodiscard]] CapStand circling_cap(double time_s);

// Returns the reports of a cap that stood as `before` in the reports before: its buttons where they have changed, and
// push and turn unless it rests and has rested. Pure.
[[nodiscard]] std::vector<HidBytes> cap_reports(const CapStand& before, const CapStand& now, bool joined);

struct EmulatedSpaceMouseOptions {
    bool joined = true;  // as a SpaceMouse Wireless; else as a SpaceNavigator
    std::function<CapStand(double time_s)> script = circling_cap;
    SilenceDrill silence;  // its cable is pulled then
};

class EmulatedSpaceMouse {
public:
    // Fails where one of that name runs already.
    [[nodiscard]] static Result<EmulatedSpaceMouse> create(const std::string& name,
                                                           EmulatedSpaceMouseOptions options = {});
    // Runs in real time until `ends` says so, which is asked each 2 ms.
    void run(const std::function<bool()>& ends);

    // Drills. Silent: its cable is there and no report comes. Pulled: its cable is.
    void fall_silent(bool is_silent) { drill_->is_silent = is_silent; }
    void pull_cable(bool is_pulled) { drill_->is_pulled = is_pulled; }
    // Sends so many bytes as a report each time, whatever they are; empty: those of the script.
    void send_instead(HidBytes bytes) {
        const std::lock_guard held(drill_->lock);
        drill_->instead = std::move(bytes);
    }
    [[nodiscard]] bool has_host() const { return drill_->has_host; }

private:
    struct Drill {
        std::atomic<bool> is_silent = false, is_pulled = false, has_host = false;
        std::mutex lock;
        HidBytes instead;  // under the lock
    };
    EmulatedSpaceMouse(OwnedFile listener, EmulatedSpaceMouseOptions options)
        : listener_(std::move(listener)), options_(std::move(options)) {}
    void report(const OwnedFile& host, const CapStand& cap);

    OwnedFile listener_;
    EmulatedSpaceMouseOptions options_;
    std::unique_ptr<Drill> drill_ = std::make_unique<Drill>();
    CapStand told_;
};

}  // namespace burin::devices
