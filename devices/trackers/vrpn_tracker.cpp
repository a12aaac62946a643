// SPDX-License-Identifier: MIT
#include "devices/trackers/vrpn_tracker.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::devices {
namespace {

constexpr const char* kVrpnRemedy =
    "write vrpn:HOST or vrpn:HOST:PORT, and after a comma which of its devices they are, such as "
    "vrpn:10.0.0.2,head=Tracker0/0,wand0=Tracker0/1,buttons0=Button0,stick0=Analog0";
const TrackerBodies& usual_bodies() {
    static const TrackerBodies bodies{.head = {{"Tracker0", 0}},
                                      .wands = {{{{"Tracker0", 1}}, {{"Tracker0", 2}}}},
                                      .buttons = {{{{"Button0", 0}}, std::nullopt}},
                                      .sticks = {{{{"Analog0", 0}}, std::nullopt}}};
    return bodies;
}

constexpr std::string_view kControl = "VRPN Control";

// Returns which devices are asked for, and for what. Of the usual ones only the head's is missed where it is not there.
std::vector<std::pair<std::string, std::string>> devices_of(const TrackerBodies& bodies) {
    std::vector<std::pair<std::string, std::string>> wanted;
    const auto add = [&](const std::string& part, const std::optional<TrackedSource>& source) {
        if (source && (bodies.are_named || wanted.empty())) wanted.emplace_back(part, source->name);
    };
    add("head", bodies.head);
    for (std::size_t i = 0; i < kTrackedWands; ++i) {
        add(formatted("wand%zu", i), bodies.wands[i]);
        add(formatted("buttons%zu", i), bodies.buttons[i]);
        add(formatted("stick%zu", i), bodies.sticks[i]);
    }
    return wanted;
}

bool is_named(const VrpnNames& names, const std::string& device) {
    return std::ranges::find(names.senders(), device) != names.senders().end();
}

// Returns the devices that a server has named, for people.
std::string devices_named(const VrpnNames& names) {
    std::string devices;
    for (const std::string& sender : names.senders())
        if (!sender.empty() && sender != kControl) devices += (devices.empty() ? "" : ", ") + sender;
    return devices;
}

bool send_all(int socket, const std::vector<std::byte>& bytes) {
    // What a server does not take now is lost with the connection: it takes a few hundred bytes in all.
    return ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

// Reads what has come; false where the connection has ended.
bool read_some(VrpnConnection& connection) {
    const auto room = connection.reader->room();
    const ssize_t count = ::recv(connection.socket.get(), room.data(), room.size(), 0);
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    connection.reader->came(static_cast<std::size_t>(count));
    return count > 0;
}

// Says how old the newest pose of a server on this machine is, in steps that a person tells apart. -1: none has come;
// 0: it has no time.
std::string age_text(std::int64_t newest_us) {
    constexpr double kFresh_s = 0.1;
    if (newest_us < 0) return "; no pose comes";
    if (newest_us == 0) return "; its poses have no time";
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const double age_s =
        1e-6 * static_cast<double>(std::chrono::duration_cast<std::chrono::microseconds>(now).count() - newest_us);
    if (std::abs(age_s) < kFresh_s) return "; its poses are less than 0.1 s old";
    return formatted("; its newest pose is %.1f s old: stale, or of another clock", age_s);
}

}  // namespace

std::expected<VrpnConnection, std::string> connect_to_vrpn(const NetworkAddress& to, const StopSign& stop) {
    auto socket = connect_to(to, kVrpnAnswer_ns, &stop);
    if (!socket) return std::unexpected("cannot be reached at " + to.text() + ": " + socket.error());
    VrpnConnection connection{std::move(*socket), std::make_unique<VrpnReader>(), {}};
    if (!send_all(connection.socket.get(), VrpnBytes().cookie().bytes()))
        return std::unexpected(to.text() + " takes no bytes");
    MonotonicClock clock;
    const Nanoseconds until_ns = clock.now_ns() + kVrpnAnswer_ns;
    for (Nanoseconds now_ns = clock.now_ns(); now_ns < until_ns; now_ns = clock.now_ns()) {
        const int left_ms = static_cast<int>((until_ns - now_ns) / 1'000'000) + 1;
        const auto woken = stop.wait_for(connection.socket.get(), left_ms);
        if (woken == StopSign::Woken::by_sign) break;
        if (woken == StopSign::Woken::by_file && !read_some(connection))
            return std::unexpected("closes the connection at once");
        // The version is known when the first message is asked for; none is lost, as the reader keeps it.
        connection.reader->read_version();
        if (connection.reader->failure()) return std::unexpected(*connection.reader->failure());
        if (connection.reader->has_cookie()) return connection;
    }
    return std::unexpected(std::string("takes the connection and says nothing, as no VRPN server does"));
}

std::vector<DevicePresence> look_for_vrpn() { return look_for_vrpn_at({"127.0.0.1", kVrpnPort}); }

std::vector<DevicePresence> look_for_vrpn_at(const NetworkAddress& here) {
    const std::string name = "vrpn:" + here.text();
    const StopSign stop;
    auto connection = connect_to_vrpn(here, stop);
    if (!connection)
        return {{Presence::absent, name, "a VRPN server " + connection.error(),
                 "start one, or burin devices emulate vrpn; name one on another machine: --tracker vrpn:HOST"}};
    // A server names its devices at once, and one that tracks reports many times a second.
    constexpr int kNames_ms = 200;
    std::int64_t newest_us = -1;
    MonotonicClock clock;
    const Nanoseconds until_ns = clock.now_ns() + Nanoseconds{kNames_ms} * 1'000'000;
    do {
        while (const auto message = connection->reader->next())
            if (!connection->names.take(*message) && connection->names.type(message->type) == kVrpnPose)
                newest_us = std::max(newest_us, message->time_us);
    } while (clock.now_ns() < until_ns &&
             stop.wait_for(connection->socket.get(), kNames_ms) == StopSign::Woken::by_file && read_some(*connection));
    const std::string devices = devices_named(connection->names);
    return {{Presence::there,
             name,
             "a VRPN server, version " + connection->reader->version() +
                 (devices.empty() ? ", which names no device" : ", with " + devices) + age_text(newest_us),
             {}}};
}

Result<std::unique_ptr<Tracker>> VrpnTracker::open(const std::string& where, TrackerHost host) {
    std::vector<std::string> items;
    std::istringstream rest(where.substr(std::string_view("vrpn:").size()));
    for (std::string item; std::getline(rest, item, ',');) items.push_back(item);
    const std::size_t at = items.empty() ? std::string::npos : items.front().find('@');
    if (at != std::string::npos)
        return fail("tracker " + where, "names a device before its server, as VRPN's own programs do",
                    "write vrpn:" + items.front().substr(at + 1) + ",head=" + items.front().substr(0, at));
    const auto server = network_address(items.empty() ? "" : items.front(), {"127.0.0.1", kVrpnPort});
    if (!server) return fail("tracker " + where, "names no server", kVrpnRemedy);
    if (!items.empty()) items.erase(items.begin());
    BURIN_TRY(bodies, tracker_bodies(where, items, usual_bodies(), host));
    std::unique_ptr<VrpnTracker> tracker(new VrpnTracker(where, *server, std::move(bodies), std::move(host)));
    auto connection = connect_to_vrpn(*server, tracker->stop_);
    if (!connection)
        return fail("tracker " + where, connection.error(),
                    "start its server, or burin devices emulate vrpn, and see that the address is right");
    tracker->thread_ = std::thread([t = tracker.get(), c = std::move(*connection)]() mutable { t->run(std::move(c)); });
    return std::unique_ptr<Tracker>(std::move(tracker));
}

VrpnTracker::VrpnTracker(const std::string& where, NetworkAddress server, TrackerBodies bodies, TrackerHost host)
    : host_(std::move(host)),
      server_(std::move(server)),
      wanted_(devices_of(bodies)),
      translator_(where, std::move(bodies), inbox_) {}

VrpnTracker::~VrpnTracker() {
    stop_.give();
    if (thread_.joinable()) thread_.join();
}

void VrpnTracker::run(VrpnConnection connection) {
    while (true) {
        inbox_.say("the VRPN server at " + server_.text() + " is there, version " + connection.reader->version());
        const std::string why = follow(connection);
        translator_.lose_all(host_.clock.now_ns());
        if (why.empty()) return;
        inbox_.say("the VRPN server at " + server_.text() + " " + why + ": it is looked for again");
        if (host_.on_sample) host_.on_sample();
        auto again = find_again();
        if (!again) return;
        connection = std::move(*again);
    }
}

// Takes what the server sends until the connection is of no use; returns why, empty when told to end.
std::string VrpnTracker::follow(VrpnConnection& connection) {
    VrpnBytes names;
    names.name(kVrpnType, 0, kVrpnPing).name(kVrpnType, 1, kVrpnPong);
    if (!send_all(connection.socket.get(), names.bytes())) return "takes no bytes";
    described_.clear();
    Nanoseconds heard_ns = host_.clock.now_ns(), pinged_ns = heard_ns;
    std::optional<Nanoseconds> named_ns;
    bool told_of_missing = false;
    while (true) {
        bool has_message = false;
        while (const auto message = connection.reader->next()) {
            take_message(connection, *message);
            has_message = true;
        }
        if (connection.reader->failure()) return *connection.reader->failure();
        if (has_message && host_.on_sample) host_.on_sample();
        const auto woken = stop_.wait_for(connection.socket.get(), 200);
        if (woken == StopSign::Woken::by_sign) return {};
        const Nanoseconds now_ns = host_.clock.now_ns();
        if (!named_ns && !devices_named(connection.names).empty()) named_ns = now_ns;
        if (named_ns && now_ns - *named_ns > kMissing_ns && !std::exchange(told_of_missing, true))
            tell_of_missing(connection.names);
        if (translator_.lose_stopped(now_ns) && host_.on_sample) host_.on_sample();
        if (woken == StopSign::Woken::by_file) {
            if (!read_some(connection)) return "has closed the connection";
            heard_ns = now_ns;
        }
        if (now_ns - heard_ns > kSilent_ns) return "is silent";
        if (now_ns - heard_ns > kQuiet_ns && now_ns - pinged_ns > kQuiet_ns) {
            pinged_ns = now_ns;
            ping(connection);
        }
    }
}

// Pings a device that the server has: one that is asked for, or else whichever it has named.
void VrpnTracker::ping(const VrpnConnection& connection) {
    std::string device;
    for (const std::string& sender : connection.names.senders())
        if (device.empty() && sender != kControl) device = sender;
    for (const auto& [part, wanted] : wanted_)
        if (is_named(connection.names, wanted)) device = wanted;
    if (device.empty()) return;
    // It has to be told by which number it is meant.
    VrpnBytes said;
    auto known = std::ranges::find(described_, device);
    const auto number = static_cast<std::int32_t>(known - described_.begin());
    if (known == described_.end()) {
        described_.push_back(device);
        said.name(kVrpnSender, number, device);
    }
    static_cast<void>(send_all(connection.socket.get(), said.message(number, 0).bytes()));
}

void VrpnTracker::tell_of_missing(const VrpnNames& names) {
    std::string missing;
    for (const auto& [part, device] : wanted_)
        if (!is_named(names, device)) missing += (missing.empty() ? "" : ", ") + part + " = " + device;
    if (missing.empty()) return;
    inbox_.say("the VRPN server at " + server_.text() + " has no device for " + missing + "; it names " +
               devices_named(names));
}

std::optional<VrpnConnection> VrpnTracker::find_again() {
    while (stop_.wait_for(-1, 1000) == StopSign::Woken::by_time) {
        auto connection = connect_to_vrpn(server_, stop_);
        if (connection) return std::move(*connection);
    }
    return std::nullopt;
}

void VrpnTracker::take_message(VrpnConnection& connection, const VrpnMessage& message) {
    if (connection.names.take(message)) return;
    const Nanoseconds now_ns = host_.clock.now_ns();
    const std::string_view sender = connection.names.sender(message.sender);
    const std::string_view type = connection.names.type(message.type);
    const auto is_short = [&] {
        translator_.refuse("sends a message of " + std::string(type) + " that is too short", now_ns);
    };
    if (type == kVrpnPose) {
        const auto pose = vrpn_pose(message.payload);
        if (!pose) return is_short();
        translator_.pose(sender, pose->sensor, {pose->position_m, pose->orientation}, true, now_ns,
                         message.time_us > 0 ? std::optional(message.time_us * 1000) : std::nullopt);
    } else if (type == kVrpnButton) {
        const auto button = vrpn_button(message.payload);
        if (!button) return is_short();
        translator_.button(sender, button->button, button->state != 0, now_ns);
    } else if (type == kVrpnButtons) {
        const auto states = vrpn_buttons(message.payload);
        if (!states) return is_short();
        for (std::size_t i = 0; i < states->size(); ++i)
            translator_.button(sender, static_cast<std::int32_t>(i), (*states)[i] != 0, now_ns);
    } else if (type == kVrpnChannels) {
        const auto channels = vrpn_channels(message.payload);
        if (!channels) return is_short();
        translator_.channels(sender, *channels, now_ns);
    }
}

}  // namespace burin::devices
