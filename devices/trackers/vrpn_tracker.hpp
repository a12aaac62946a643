// SPDX-License-Identifier: MIT
// Heads and wands from a VRPN server: vrpn:HOST:PORT with which of its devices they are (tracker_bodies.hpp).
//
// Data flow: TCP connection -> VrpnReader -> names of the server's numbers -> TrackerTranslator -> inbox. Everything
// stays on the one TCP connection, since the server is told of no UDP port. A server that has sent nothing for a second
// is sent pings. It answers those of a device that it has, and "VRPN Control" is none: so what is pinged is a device
// that it has named itself. A device that was asked for and is not among its names is told of kMissing_ns after these
// have come. A server that is silent for kSilent_ns, that closes the connection or sends what is no
// VRPN is left, its bodies are lost and its buttons released, and it is looked for again once a second.
// A pose that comes late by the server's own time stamps is stale, and a body that stops is lost, as TrackerTranslator
// has it.
// Failures: a machine or server that is not there, and another version, are errors of open(); later ones are messages.
// Threads: as Tracker has it; the host's functions are called on the tracker's own thread.
#pragma once

#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/trackers/network.hpp"
#include "devices/trackers/tracker_bodies.hpp"
#include "devices/trackers/vrpn_protocol.hpp"

namespace burin::devices {

// A connection whose cookies agree.
struct VrpnConnection {
    OwnedFile socket;
    std::unique_ptr<VrpnReader> reader;
    VrpnNames names;
};
inline constexpr Nanoseconds kVrpnAnswer_ns = 2'000'000'000;
// Connects, within kVrpnAnswer_ns; the text says what is wrong. `stop` ends it early.
[[nodiscard]] std::expected<VrpnConnection, std::string> connect_to_vrpn(const NetworkAddress& to,
                                                                         const StopSign& stop);

// Looks for a server on this machine at VRPN's own port, which devices it names, and how old its newest pose is.
[[nodiscard]] std::vector<DevicePresence> look_for_vrpn();
[[nodiscard]] std::vector<DevicePresence> look_for_vrpn_at(const NetworkAddress& here);

class VrpnTracker final : public Tracker {
public:
    static constexpr Nanoseconds kQuiet_ns = 1'000'000'000, kSilent_ns = 3'000'000'000, kMissing_ns = 1'000'000'000;

    [[nodiscard]] static Result<std::unique_ptr<Tracker>> open(const std::string& where, TrackerHost host);
    ~VrpnTracker() override;
    VrpnTracker(const VrpnTracker&) = delete;
    VrpnTracker& operator=(const VrpnTracker&) = delete;

    [[nodiscard]] std::vector<TrackerSample> take() override { return inbox_.take(); }
    [[nodiscard]] std::vector<std::string> take_messages() override { return inbox_.take_messages(); }
    [[nodiscard]] std::uint64_t refused() const override { return inbox_.refused(); }

private:
    VrpnTracker(const std::string& where, NetworkAddress server, TrackerBodies bodies, TrackerHost host);
    void run(VrpnConnection connection);
    [[nodiscard]] std::string follow(VrpnConnection& connection);
    [[nodiscard]] std::optional<VrpnConnection> find_again();
    void take_message(VrpnConnection& connection, const VrpnMessage& message);
    void ping(const VrpnConnection& connection);
    void tell_of_missing(const VrpnNames& names);

    TrackerHost host_;
    NetworkAddress server_;
    // The devices that heads, wands, buttons and sticks are asked of, as (part, device).
    std::vector<std::pair<std::string, std::string>> wanted_;
    std::vector<std::string> described_;  // the devices that this connection has been told of, by the numbers for them
    TrackerInbox inbox_;
    TrackerTranslator translator_;
    StopSign stop_;
    std::thread thread_;
};

}  // namespace burin::devices
