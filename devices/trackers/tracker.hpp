// SPDX-License-Identifier: MIT
// What a tracker is: a source of poses of a head and of wands, with the wands' buttons and sticks, as plain data; and
// the registry of all trackers that there are. To add one, write its source beside udp_tracker.cpp and enter it in the
// table of tracker_registry.cpp: the help of --tracker and its parsing read that table.
//
// Frame: world, metres (base/space.hpp). Times: arrival, on the process's one clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/space.hpp"
#include "devices/presence/device_presence.hpp"
#include "devices/trackers/tracker_input.hpp"

namespace burin::devices {

// The samples that nobody has taken yet, at most kMost of them. When it is full, the oldest pose or stick makes room,
// since a newer one of its kind replaces it and a head's prediction wants the newest; a press or release, which nothing
// replaces, only where there is nothing else. One thread at a time.
class TrackerQueue {
public:
    static constexpr std::size_t kMost = 4096;  // seconds of a fast tracker

    // Returns false when an older sample was dropped for this one.
    bool push(TrackerSample sample);
    [[nodiscard]] std::vector<TrackerSample> take();  // in order of arrival

private:
    std::deque<TrackerSample> samples_;
};

// Threads: all functions from one thread; a tracker listens on threads of its own.
class Tracker {
public:
    virtual ~Tracker() = default;
    [[nodiscard]] virtual std::vector<TrackerSample> take() = 0;         // since the last call, in order of arrival
    [[nodiscard]] virtual std::vector<std::string> take_messages() = 0;  // for the user
    [[nodiscard]] virtual std::uint64_t refused() const = 0;             // samples dropped so far
};

struct TrackerBodies;  // tracker_bodies.hpp

// What a tracker needs of the program. The clock must outlive the tracker.
struct TrackerHost {
    Clock& clock;
    std::function<void()> on_sample;  // called on the tracker's threads after each arrival; must not block
    // Reads a line of text for trackers that send such; nothing for an empty line or a comment. Called on the tracker's
    // threads.
    std::function<Result<std::optional<TrackerInput>>(std::string_view line)> parse_line;
    // What a description of the tracker says (tracker_file.hpp); open() copies it. Null: there is none, and bodies have
    // their usual names.
    const TrackerBodies* described = nullptr;
    // Where the frame that the tracker reports in stands in the world, as the wall's file says; a description may know
    // better. Lines of text are of the world where there is no description.
    Pose world_from_tracker{};
};

struct TrackerKind {
    std::string_view scheme;  // what --tracker begins with, before a colon
    std::string_view usage;   // how to write the rest, for help and messages
    Result<std::unique_ptr<Tracker>> (*open)(const std::string& where, TrackerHost host);
    // Looks for what can be found without being named; null: it is sent to, and there is nothing to find.
    std::vector<DevicePresence> (*look)() = nullptr;
    // What its bodies, buttons and sticks can be called, with a number behind; empty: as a server likes.
    std::span<const std::string_view> names = {};
    // Its protocol says what unit its lengths have.
    bool has_unit = false;
    bool may_be_bare = false;  // the scheme alone, without a colon, names one
};
[[nodiscard]] std::span<const TrackerKind> tracker_kinds();
// Returns the kind of an address, "vrpn:localhost"; null where there is none.
[[nodiscard]] const TrackerKind* tracker_kind_of(std::string_view where);

// Opens the tracker that `where` names, "udp:5005". An Error names the kinds that there are.
[[nodiscard]] Result<std::unique_ptr<Tracker>> open_tracker(const std::string& where, TrackerHost host);

// Returns the usage of all kinds, for the help of --tracker.
[[nodiscard]] std::string tracker_usage();

}  // namespace burin::devices
