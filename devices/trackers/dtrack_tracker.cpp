// SPDX-License-Identifier: MIT
#include "devices/trackers/dtrack_tracker.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::devices {
namespace {

constexpr std::size_t kMostDatagram = 65'536;  // the most that UDP carries
constexpr const char* kDTrackRemedy =
    "write dtrack:PORT, or dtrack:ADDRESS:PORT with an address of this machine, such as dtrack:0.0.0.0:5000, or of a "
    "multicast group, and after a comma which of its bodies they are: head=body/0,wand0=flystick/0,axes=+x+z-y";
// A measurement that is older than the newest by more than this is of a system that has begun anew.
constexpr std::uint32_t kOvertaken = 100;

std::string flystick_named(std::int32_t number) { return "flystick" + std::to_string(number); }

const TrackerBodies& usual_dtrack_bodies() {
    static const TrackerBodies bodies{
        .head = {{"body", 0}}, .wands = {{{{"flystick", 0}}, {{"flystick", 1}}}}, .buttons = {}, .sticks = {}};
    return bodies;
}

// A flystick's buttons and stick come with it.
TrackerBodies with_their_buttons(TrackerBodies bodies) {
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        if (!bodies.wands[wand] || bodies.wands[wand]->name != "flystick") continue;
        const TrackedSource own{flystick_named(bodies.wands[wand]->number), 0};
        if (!bodies.buttons[wand]) bodies.buttons[wand] = own;
        if (!bodies.sticks[wand]) bodies.sticks[wand] = own;
    }
    return bodies;
}

}  // namespace

Result<std::unique_ptr<DTrackTracker>> DTrackTracker::open(const std::string& where, TrackerHost host) {
    std::vector<std::string> items;
    std::istringstream rest(where.substr(std::string_view("dtrack:").size()));
    for (std::string item; std::getline(rest, item, ',');) items.push_back(item);
    const auto at = network_address(items.empty() ? "" : items.front(), {"127.0.0.1", kDTrackPort});
    if (!at) return fail("tracker " + where, "has no such port or address", kDTrackRemedy);
    if (!items.empty()) items.erase(items.begin());
    BURIN_TRY(bodies, tracker_bodies(where, items, usual_dtrack_bodies(), host));
    auto bound = receive_at(*at);
    if (!bound && bound.error().starts_with(kNoSuchMachine))  // a word where the port belongs is taken for a machine
        return fail("tracker " + where, "has no such port or address: " + at->host + " is neither", kDTrackRemedy);
    if (!bound)
        return fail("tracker " + where, "cannot be listened to: " + bound.error(),
                    "another program may have the port; choose another one, or an address of this machine");
    std::unique_ptr<DTrackTracker> tracker(
        new DTrackTracker(where, std::move(*bound), with_their_buttons(std::move(bodies)), std::move(host)));
    tracker->thread_ = std::thread([t = tracker.get()] { t->run(); });
    return tracker;
}

Result<std::unique_ptr<Tracker>> open_dtrack(const std::string& where, TrackerHost host) {
    return DTrackTracker::open(where, std::move(host));
}

DTrackTracker::~DTrackTracker() {
    stop_.give();
    if (thread_.joinable()) thread_.join();
}

void DTrackTracker::run() {
    std::vector<char> datagram(kMostDatagram);
    while (true) {
        const auto woken = stop_.wait_for(at_.socket.get(), 200);
        if (woken == StopSign::Woken::by_sign) return;
        const Nanoseconds now_ns = host_.clock.now_ns();
        if (woken == StopSign::Woken::by_file) {
            sockaddr_in from{};
            socklen_t size = sizeof(from);
            const ssize_t count = ::recvfrom(at_.socket.get(), datagram.data(), datagram.size(), 0,
                                             reinterpret_cast<sockaddr*>(&from), &size);
            if (count >= 0)
                receive({datagram.data(), static_cast<std::size_t>(count)}, ntohl(from.sin_addr.s_addr), now_ns);
        }
        if (translator_.lose_stopped(now_ns) && host_.on_sample) host_.on_sample();
        if (sender_ != 0 && now_ns - heard_ns_ > kSilent_ns) {
            translator_.lose_all(now_ns);
            inbox_.say("DTrack is silent: it is waited for");
            sender_ = 0;
            number_.reset();
            if (host_.on_sample) host_.on_sample();
        }
    }
}

void DTrackTracker::receive(std::string_view datagram, std::uint32_t sender, Nanoseconds now_ns) {
    if (sender_ != 0 && sender != sender_)
        return translator_.refuse("gets measurements of a second machine, and listens to the first", now_ns);
    const DTrackFrame frame = dtrack_frame(datagram);
    if (!frame.fault.empty())
        translator_.refuse("cannot read a line of measurements that begins with " + frame.fault, now_ns);
    const bool is_measurement =
        frame.number || !frame.bodies.empty() || !frame.hybrids.empty() || !frame.flysticks.empty();
    if (!is_measurement) {
        if (frame.fault.empty()) translator_.refuse("gets what is no measurement of DTrack", now_ns);
        return;
    }
    if (sender_ == 0) {
        in_addr address{};
        address.s_addr = htonl(sender);
        std::array<char, INET_ADDRSTRLEN> text{};
        ::inet_ntop(AF_INET, &address, text.data(), text.size());
        inbox_.say("DTrack at " + std::string(text.data()) + " is there");
    }
    sender_ = sender;
    heard_ns_ = now_ns;
    if (frame.number && number_ && *frame.number < *number_ && *number_ - *frame.number < kOvertaken)
        return translator_.refuse("gets a measurement after a newer one", now_ns);
    if (frame.number) number_ = frame.number;
    for (const DTrackBody& body : frame.bodies)
        translator_.pose("body", body.number, body.pose, body.is_tracked, now_ns);
    for (const DTrackBody& body : frame.hybrids)
        translator_.pose("hybrid", body.number, body.pose, body.is_tracked, now_ns);
    for (const DTrackFlystick& stick : frame.flysticks) {
        translator_.pose("flystick", stick.body.number, stick.body.pose, stick.body.is_tracked, now_ns);
        const std::string name = flystick_named(stick.body.number);
        for (std::uint32_t button = 0; button < stick.button_count; ++button)
            translator_.button(name, static_cast<std::int32_t>(button), (stick.buttons >> button & 1u) != 0, now_ns);
        if (stick.sticks.size() >= 2) translator_.channels(name, stick.sticks, now_ns);
    }
    if (host_.on_sample) host_.on_sample();
}

}  // namespace burin::devices
