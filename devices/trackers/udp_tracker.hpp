// SPDX-License-Identifier: MIT
// Receives trackers of any make over the network: datagrams of text, a sample a line, such as "head 0 1.6 2 0 0 0 1"
// (docs/formats.md). A few lines of script bridge VRPN, OptiTrack or a phone to it.
//
// Where a description says what is tracked (tracker_file.hpp), poses are in the tracker's frame and unit, and go
// through a TrackerTranslator: bodies are head/0, wand/0 and wand/1, with buttons and sticks named wand0 and wand1.
//
// Each sample is stamped on arrival, on a thread that does nothing else, so that the head's prediction does not take
// the frame's delay for the tracker's. Lines that cannot be parsed are dropped, counted, and reported at most once a
// second.
// Threads: as Tracker has it; the host's functions are called on the port's own thread.
#pragma once

#include <thread>

#include "devices/trackers/tracker_bodies.hpp"

namespace burin::devices {

class UdpTracker final : public Tracker {
public:
    // Opens a port. where: "udp:PORT" accepts this machine alone; "udp:ADDRESS:PORT" accepts whoever reaches that
    // address of this machine. PORT 0: any free one.
    [[nodiscard]] static Result<std::unique_ptr<UdpTracker>> open(const std::string& where, TrackerHost host);
    ~UdpTracker() override;
    UdpTracker(const UdpTracker&) = delete;
    UdpTracker& operator=(const UdpTracker&) = delete;

    [[nodiscard]] std::vector<TrackerSample> take() override { return inbox_.take(); }
    [[nodiscard]] std::vector<std::string> take_messages() override { return inbox_.take_messages(); }
    [[nodiscard]] std::uint64_t refused() const override { return inbox_.refused(); }
    [[nodiscard]] std::uint16_t port() const { return port_; }

private:
    explicit UdpTracker(TrackerHost host) : host_(std::move(host)) {}
    [[nodiscard]] Result<void> bind_to(const std::string& where);
    void listen();
    void receive(std::string_view datagram, bool cut_off, Nanoseconds now_ns);
    void translate(const TrackerInput& input, Nanoseconds now_ns);

    TrackerHost host_;
    int socket_ = -1, stop_ = -1;
    std::uint16_t port_ = 0;
    TrackerInbox inbox_;
    std::optional<TrackerTranslator> translator_;  // with a description
    std::thread thread_;
};

// UdpTracker::open() for the registry.
[[nodiscard]] Result<std::unique_ptr<Tracker>> open_udp_tracker(const std::string& where, TrackerHost host);

}  // namespace burin::devices
