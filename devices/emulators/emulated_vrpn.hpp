// SPDX-License-Identifier: MIT
// A VRPN server that tracks nobody: the devices Tracker0 (sensor 0 the head, sensor 1 the wand), Button0 and Analog0,
// which follow emulated_motion(). It speaks VRPN over TCP to a few clients at once, by a code of its own
// (vrpn_wire.hpp), and answers their pings; for tests and for trying a wall without a tracker. VRPN's own clients do
// not connect: they send a datagram "ADDRESS PORT" to the server's port and have it call back; it does so for the
// sender's own address alone. One thread.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/emulators/emulated_motion.hpp"
#include "devices/emulators/vrpn_wire.hpp"
#include "devices/trackers/network.hpp"

namespace burin::devices {

// Returns what it says to a client that has come: what there is, and how button and stick stand. Pure, as are the
// others.
[[nodiscard]] VrpnServerBytes emulated_vrpn_greeting(const EmulatedMotion& now);
// Returns a report: both poses, and button and stick where they are not as in the report before.
[[nodiscard]] VrpnServerBytes emulated_vrpn_report(const EmulatedMotion& before, const EmulatedMotion& now,
                                                   std::int64_t time_us);
// Returns the answer to a ping of one of the devices; nothing where the message asks for none.
[[nodiscard]] std::optional<VrpnServerBytes> emulated_vrpn_answer(const HeardVrpn& said);

struct EmulatedVrpnOptions {
    double rate_Hz = 60.0;
    double begins_s = 0.0;      // of the emulated motion
    SilenceDrill silence = {};  // closes all connections then, and takes none
};

class EmulatedVrpn {
public:
    // More connections are closed at once.
    static constexpr std::size_t kMostClients = 8;

    // Listens; port 0: a free one. An Error says why it cannot.
    [[nodiscard]] static Result<EmulatedVrpn> create(const NetworkAddress& at);
    [[nodiscard]] const NetworkAddress& address() const { return at_.bound; }
    // Serves until `ends` says so, which is asked at least 50 times a second.
    void run(const EmulatedVrpnOptions& options, const std::function<bool()>& ends);
    // Returns the pings that it has answered. Any thread.
    [[nodiscard]] std::uint64_t pings() const { return pings_->load(std::memory_order_relaxed); }

private:
    struct Client {
        OwnedFile socket;
        VrpnServerEar ear;
    };
    EmulatedVrpn(BoundSocket at, BoundSocket lobs) : at_(std::move(at)), lobs_(std::move(lobs)) {}
    void accept_clients(const EmulatedMotion& now);
    void call_back(const EmulatedMotion& now);
    void greet(OwnedFile socket, const EmulatedMotion& now);
    [[nodiscard]] bool serve(Client& client);

    BoundSocket at_;    // where clients connect
    BoundSocket lobs_;  // where they ask to be called back
    std::vector<Client> clients_;
    EmulatedMotion told_;
    std::unique_ptr<std::atomic<std::uint64_t>> pings_ = std::make_unique<std::atomic<std::uint64_t>>(0);
};

}  // namespace burin::devices
