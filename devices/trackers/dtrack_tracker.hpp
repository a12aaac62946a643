// SPDX-License-Identifier: MIT
// Heads and wands from ART's DTrack: dtrack:PORT or dtrack:ADDRESS:PORT, and which of its bodies they are
// (tracker_bodies.hpp). A standard body is body/NUMBER, a hybrid one with an inertial sensor hybrid/NUMBER, a flystick
// is flystick/NUMBER with its buttons and stick.
//
// The port is this machine's own unless an address is named; one of a multicast group is joined on all networks of the
// machine. The first machine that sends a measurement is the one that
// is listened to, until it has been silent for kSilent_ns; what others send is counted and told. A measurement that was
// overtaken on its way by a newer one is left out.
// Failures: a port that is taken and an address that is not this machine's are errors of open(); later ones are
// messages.
// Threads: as Tracker has it; the host's functions are called on the port's own thread.
#pragma once

#include <memory>
#include <thread>

#include "devices/trackers/dtrack_protocol.hpp"
#include "devices/trackers/network.hpp"
#include "devices/trackers/tracker_bodies.hpp"

namespace burin::devices {

class DTrackTracker final : public Tracker {
public:
    static constexpr Nanoseconds kSilent_ns = 1'000'000'000;

    [[nodiscard]] static Result<std::unique_ptr<DTrackTracker>> open(const std::string& where, TrackerHost host);
    ~DTrackTracker() override;
    DTrackTracker(const DTrackTracker&) = delete;
    DTrackTracker& operator=(const DTrackTracker&) = delete;

    [[nodiscard]] std::vector<TrackerSample> take() override { return inbox_.take(); }
    [[nodiscard]] std::vector<std::string> take_messages() override { return inbox_.take_messages(); }
    [[nodiscard]] std::uint64_t refused() const override { return inbox_.refused(); }
    [[nodiscard]] std::uint16_t port() const { return at_.bound.port; }

private:
    DTrackTracker(const std::string& where, BoundSocket at, TrackerBodies bodies, TrackerHost host)
        : host_(std::move(host)), at_(std::move(at)), translator_(where, std::move(bodies), inbox_) {}
    void run();
    void receive(std::string_view datagram, std::uint32_t sender, Nanoseconds now_ns);

    TrackerHost host_;
    BoundSocket at_;
    TrackerInbox inbox_;
    TrackerTranslator translator_;
    StopSign stop_;
    // Of the thread:
    std::uint32_t sender_ = 0;  // its address; 0: nobody is listened to
    Nanoseconds heard_ns_ = 0;
    std::optional<std::uint32_t> number_;
    std::thread thread_;
};

// DTrackTracker::open() for the registry.
[[nodiscard]] Result<std::unique_ptr<Tracker>> open_dtrack(const std::string& where, TrackerHost host);

}  // namespace burin::devices
