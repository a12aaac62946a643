// SPDX-License-Identifier: MIT
// Which of a tracking system's bodies is the head and which the wands, and what its reports mean in the world: for
// trackers whose bodies have names and numbers of their own (VRPN's devices and sensors, DTrack's bodies and
// flysticks).
//
// Frame: the system's own, metres, taken into the world by `axes`, which renames axes for places and turns alike: a
// body that stands as the system's axes do stands as the world's axes do. Where the system's origin is in the world is
// the wall file's (world_from_tracker). Where the eyes are at the head's sensor is, too.
// One thread at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "devices/trackers/tracker_inbox.hpp"

namespace burin::devices {

inline constexpr std::size_t kTrackedWands = 2;
inline constexpr std::int32_t kMostTrackedButtons = 32;
inline constexpr double kMostTracked_m = 1000.0;  // beyond it a position is in another unit, or nonsense

struct TrackedSource {
    std::string name;         // of the device, as the tracking system calls it
    std::int32_t number = 0;  // of the sensor; of the first button or channel
    friend bool operator==(const TrackedSource&, const TrackedSource&) = default;
};

struct TrackerBodies {
    std::optional<TrackedSource> head;
    std::array<std::optional<TrackedSource>, kTrackedWands> wands, buttons, sticks;
    Quat world_from_system{1.0, 0.0, 0.0, 0.0};
};

// Reads NAME=VALUE settings: head, wand0, wand1, buttons0, buttons1, stick0, stick1 with a value NAME/NUMBER or NAME;
// axes with a value such as +x+z-y: which of the system's axes are the world's x, y and z. Where no body is named they
// are the usual ones. `where` is for the Error, which says what is wrong and what there is.
[[nodiscard]] Result<TrackerBodies> tracker_bodies(const std::string& where, std::span<const std::string> settings,
                                                   const TrackerBodies& usual);
// Returns how to write them, for help.
[[nodiscard]] std::string_view tracker_bodies_usage();

// Turns a system's reports into samples of heads and wands, and puts those into an inbox. What is not finite, turned by
// no rotation, or of a body that has no part in this is left out; nonsense is counted and told.
class TrackerTranslator {
public:
    TrackerTranslator(std::string where, TrackerBodies bodies, TrackerInbox& to)
        : where_(std::move(where)), bodies_(std::move(bodies)), to_(to) {}

    // is_tracked false: the system has lost the body, and the pose is of no account.
    void pose(std::string_view name, std::int32_t number, const Pose& pose_system, bool is_tracked,
              Nanoseconds time_ns);
    void button(std::string_view name, std::int32_t number, bool pressed, Nanoseconds time_ns);
    void channels(std::string_view name, std::span<const double> values, Nanoseconds time_ns);
    // The system is silent: what was tracked is lost where it was, sticks rest, and what was pressed is released.
    void lose_all(Nanoseconds time_ns);
    // Counts and tells what could not be read.
    void refuse(const std::string& what, Nanoseconds time_ns) { to_.refuse("tracker " + where_ + " " + what, time_ns); }

private:
    struct Body {
        Pose last_world;
        bool is_tracked = false;
    };
    [[nodiscard]] bool is_known(std::string_view name, std::int32_t number) const;
    void report(Body& body, const Pose& pose_world, bool is_tracked, std::optional<std::uint32_t> wand,
                Nanoseconds time_ns);
    void click(std::size_t wand, std::uint32_t button, bool pressed, Nanoseconds time_ns);

    std::string where_;
    TrackerBodies bodies_;
    TrackerInbox& to_;
    Body head_;
    std::array<Body, kTrackedWands> wands_;
    std::array<std::uint32_t, kTrackedWands> pressed_{};
    std::array<Vec2, kTrackedWands> sticks_{};
};

}  // namespace burin::devices
