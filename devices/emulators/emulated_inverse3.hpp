// SPDX-License-Identifier: MIT
// Haply's service with an Inverse3 that is not there: a simulated arm in a scripted hand behind a websocket on this
// machine, with a handle of three buttons. Its messages are written after the maker's documentation and share nothing
// with the driver's: whoever connects gets the whole state, each message gets one state, a force is taken under the
// name that the version has for it alone, for the device that it names, and lasts until the next message, or for 50 ms.
// The script begins with the first message. The socket of its name says the service's port to whoever comes.
// Where the maker's text says nothing it does as the driver assumes: the middle of the workspace, the handle's turn.
// One thread runs it; drills and counts are any thread's.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/space.hpp"
#include "devices/emulators/emulated_motion.hpp"
#include "devices/hand/simulated_hand.hpp"
#include "devices/haptic/haptic_device.hpp"
#include "devices/presence/owned_file.hpp"
#include "devices/websocket/websocket_server.hpp"

namespace burin::devices {

enum class HaplyVersion : std::uint8_t { v3_1, v3_5 };
enum class HaplyHandle : std::uint8_t { none, with_cable, wireless };

struct EmulatedInverse3Options {
    std::vector<HandPose> script = {};  // of the hand, device frame; empty: circling_hand()
    SilenceDrill silence = {};          // the service ends its connections then, and holds none
    HaplyVersion version = HaplyVersion::v3_5;
    HaplyHandle handle = HaplyHandle::wireless;
    std::string id = "049D";
    std::string greeting = {};  // what it says to whoever comes; empty: the whole state
    bool greets = true;
};

class EmulatedInverse3 {
public:
    [[nodiscard]] static Result<EmulatedInverse3> create(const std::string& name, EmulatedInverse3Options options = {});
    [[nodiscard]] const NetworkAddress& service() const { return server_.address(); }
    // Runs in real time until `ends` says so, which is asked a thousand times a second.
    void run(const std::function<bool()>& ends);

    // Drills.
    void fall_silent(bool is_silent) { drill_->is_silent = is_silent; }
    // Answers this in place of the state; empty: the state. What is pushed after the first such answer is counted anew.
    void say(const std::string& text);
    void answer_late_by(double late_s) { drill_->late_s = late_s; }
    void set_calibrated(bool is_it) { drill_->is_calibrated = is_it; }
    void set_power(bool has_it) { drill_->has_power = has_it; }
    // Takes the device off the list of those that the service sees.
    void unplug(bool is_unplugged) { drill_->is_unplugged = is_unplugged; }

    // Returns the force that it was given last, newtons, device frame.
    [[nodiscard]] Vec3 written_N() const;
    // How many messages it had; how many of them it took no force from; how many pushed since the first answer that
    // say() gave it, and how many such answers there were.
    [[nodiscard]] std::uint64_t messages() const { return drill_->messages; }
    [[nodiscard]] std::uint64_t refused() const { return drill_->refused; }
    [[nodiscard]] std::uint64_t pushes_after_lie() const { return drill_->pushes; }
    [[nodiscard]] std::uint64_t lies() const { return drill_->lies; }

private:
    struct Drill {
        std::atomic<bool> is_silent = false, is_calibrated = true, has_power = true, is_unplugged = false;
        std::atomic<double> late_s = 0.0;
        std::atomic<std::uint64_t> messages = 0, refused = 0, pushes = 0, lies = 0;
        std::mutex mutex;
        std::string says;
        Vec3 written_N{0.0};
    };
    struct Owed {
        Nanoseconds due_ns = 0;
        WebSocketServer::Guest to = 0;
    };
    EmulatedInverse3(OwnedFile listener, WebSocketServer server, EmulatedInverse3Options options)
        : listener_(std::move(listener)), server_(std::move(server)), options_(std::move(options)) {}
    void hear(std::string_view text, Nanoseconds now_ns);
    [[nodiscard]] std::string state(bool is_whole) const;
    void answer(WebSocketServer::Guest to);

    OwnedFile listener_;
    WebSocketServer server_;
    EmulatedInverse3Options options_;
    std::unique_ptr<Drill> drill_ = std::make_unique<Drill>();
    DeviceSample sample_;
    std::vector<Owed> owed_;
    Nanoseconds heard_ns_ = 0;
};

}  // namespace burin::devices
