// SPDX-License-Identifier: MIT
// A VRPN server that tracks nobody: the devices Tracker0 (sensor 0 the head, sensor 1 the wand), Button0 and Analog0,
// which follow emulated_motion(). It speaks the protocol of vrpn_protocol.hpp over TCP to a few clients at once and
// answers their pings; for tests and for trying a wall without a tracker. VRPN's own clients do not connect: they send
// a datagram "ADDRESS PORT" to the server's port and have it call back; it does so for the sender's own address alone.
// One thread.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devices/emulators/emulated_motion.hpp"
#include "devices/trackers/network.hpp"
#include "devices/trackers/vrpn_protocol.hpp"

namespace burin::devices {

struct EmulatedVrpnOptions {
    double rate_Hz = 60.0;
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
        VrpnReader reader;
        VrpnNames names;
    };
    EmulatedVrpn(BoundSocket at, BoundSocket lobs) : at_(std::move(at)), lobs_(std::move(lobs)) {}
    void accept_clients(const EmulatedMotion& now);
    void call_back(const EmulatedMotion& now);
    void greet(OwnedFile socket, const EmulatedMotion& now);
    [[nodiscard]] bool serve(Client& client);

    BoundSocket at_;    // where clients connect
    BoundSocket lobs_;  // where they ask to be called back
    std::vector<Client> clients_;
    bool was_pressed_ = false;
    Vec2 stick_{0.0};
    std::unique_ptr<std::atomic<std::uint64_t>> pings_ = std::make_unique<std::atomic<std::uint64_t>>(0);
};

}  // namespace burin::devices
