// SPDX-License-Identifier: MIT
// Which of a tracking system's bodies is the head and which the wands, and what its reports mean in the world: for
// trackers whose bodies have names and numbers of their own (VRPN's devices and sensors, DTrack's bodies and
// flysticks), and for any that a description (tracker_file.hpp) places.
//
// Frames. `system`: what the tracking system reports in, of its own unit, axes and handedness. `tracker`: metres, axes
// renamed for places and turns alike, so that a body that stands as the system's axes do stands as the tracker's do:
//   position_tracker = M (unit position_system), orientation_tracker = M orientation_system M^-1,
// M being a rotation, or for a left-handed system a reflection. `body`: what is tracked; `point`: the place on it that
// counts, the middle of the eyes or a wand's tip:
//   world_from_point = world_from_tracker tracker_from_body body_from_point.
// One thread at a time.
#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/pose_motion.hpp"
#include "devices/trackers/server_delay.hpp"
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

// What counts on a body, and how late its pose is.
struct TrackedMount {
    Pose body_from_point;
    // The pose is moved on by so much, with the velocity that it had (base/pose_motion.hpp). At most kMostAhead_ns.
    Nanoseconds ahead_ns = 0;
    friend bool operator==(const TrackedMount&, const TrackedMount&) = default;
};
inline constexpr Nanoseconds kMostAhead_ns = 100'000'000;
// Velocities beyond these, of a hand that throws, are not predicted with.
inline constexpr double kMostTracked_m_per_s = 5.0, kMostTracked_rad_per_s = 20.0;

struct TrackerFrame {
    double unit_m = 1.0;                           // of what is reported
    Quat tracker_from_system{1.0, 0.0, 0.0, 0.0};  // M, or -M of a left-handed system
    bool is_left_handed = false;                   // positions change their sign before
    std::optional<Pose> world_from_tracker;        // none: as the wall's file says
    friend bool operator==(const TrackerFrame&, const TrackerFrame&) = default;
};

struct TrackerBodies {
    std::optional<TrackedSource> head;
    std::array<std::optional<TrackedSource>, kTrackedWands> wands{}, buttons{}, sticks{};
    TrackedMount head_mount{};
    std::array<TrackedMount, kTrackedWands> wand_mounts{};
    // Which of the source's buttons each of a wand's is, counted from the source's number; empty: as they come.
    std::array<std::vector<std::int32_t>, kTrackedWands> button_orders{};
    TrackerFrame frame{};
    bool are_named = false;  // by a description or by settings: what never shows is missed
    friend bool operator==(const TrackerBodies&, const TrackerBodies&) = default;
};

// Reads NAME/NUMBER or NAME; nothing where it is neither.
[[nodiscard]] std::optional<TrackedSource> tracked_source(std::string_view text);

// Which axes of a system are the tracker's x, y and z: from the rows of M, with the handedness that the system has. The
// text says what is wrong: M is no rotation, or of the other handedness.
[[nodiscard]] std::expected<TrackerFrame, std::string> frame_with_axes(const glm::dmat3& tracker_from_system,
                                                                       bool is_left_handed);

// Reads NAME=VALUE settings: head, wand0, wand1, buttons0, buttons1, stick0, stick1 with a value NAME/NUMBER or NAME;
// axes with a value such as +x+z-y: which of the system's axes are the tracker's x, y and z. They go before what the
// host's description says. Where there is none, and no body is named, bodies are the usual ones. `where` is for the
// Error, which says what is wrong and what there is.
[[nodiscard]] Result<TrackerBodies> tracker_bodies(const std::string& where, std::span<const std::string> settings,
                                                   const TrackerBodies& usual, const TrackerHost& host);
// Returns how to write them, for help.
[[nodiscard]] std::string_view tracker_bodies_usage();

// Turns a system's reports into samples of heads and wands, and puts those into an inbox. What is not finite, turned by
// no rotation, or of a body that has no part in this is left out; nonsense is counted and told. A named body that does
// not show within kPatience_ns of the first one is told of, once, with those that do.
//
// Age. Where a server stamps its poses, one that comes later than kStale_ns (server_delay.hpp) is of no account: its
// body is lost, and that is told. One with the stamp of the pose before says nothing new. A body of which nothing new
// has come for kStopped_ns is lost where it was, with a message, although the server itself may go on; the message says
// so where poses came whose stamp never changed.
class TrackerTranslator {
public:
    static constexpr Nanoseconds kPatience_ns = 5'000'000'000;
    static constexpr std::size_t kMostSeen = 100;
    // A head is drawn from its fallback after the first (wall/head_prediction.hpp).
    static constexpr Nanoseconds kStale_ns = 200'000'000, kStopped_ns = 1'000'000'000;

    TrackerTranslator(std::string where, TrackerBodies bodies, TrackerInbox& to)
        : where_(std::move(where)), bodies_(std::move(bodies)), to_(to) {}

    // is_tracked false: the system has lost the body, and the pose is of no account. stamp_ns: when it was measured, by
    // the server's clock; none: the server does not say.
    void pose(std::string_view name, std::int32_t number, const Pose& pose_system, bool is_tracked, Nanoseconds time_ns,
              std::optional<Nanoseconds> stamp_ns = std::nullopt);
    // Loses the bodies that have stopped; returns whether there were any. To be called now and then.
    bool lose_stopped(Nanoseconds time_ns);
    void button(std::string_view name, std::int32_t number, bool pressed, Nanoseconds time_ns);
    void channels(std::string_view name, std::span<const double> values, Nanoseconds time_ns);
    // The system is silent: what was tracked is lost where it was, sticks rest, and what was pressed is released.
    void lose_all(Nanoseconds time_ns);
    // Counts and tells what could not be read.
    void refuse(const std::string& what, Nanoseconds time_ns) { to_.refuse("tracker " + where_ + " " + what, time_ns); }

private:
    // The newest poses of a body, before they are moved on; and what was last told of it.
    struct Body {
        static constexpr std::size_t kMostPoses = 16;
        std::array<TimedPose, kMostPoses> poses_tracker;
        std::size_t count = 0;
        Pose last_world;
        bool is_tracked = false;
        Nanoseconds heard_ns = 0;             // when the last new pose came
        std::optional<Nanoseconds> stamp_ns;  // of that pose
        std::uint64_t repeats = 0;            // of that stamp
    };
    [[nodiscard]] bool is_known(std::string_view name, std::int32_t number) const;
    [[nodiscard]] std::optional<Pose> in_tracker(const Pose& pose_system) const;
    [[nodiscard]] Pose point_world(Body& body, const TrackedMount& mount, const TimedPose& body_tracker) const;
    void report(Body& body, const TrackedMount& mount, const std::optional<TimedPose>& body_tracker,
                std::optional<std::uint32_t> wand, Nanoseconds time_ns);
    [[nodiscard]] bool is_repeated(std::string_view name, std::int32_t number, Nanoseconds stamp_ns) const;
    void note_repeat(std::string_view name, std::int32_t number);
    void note_seen(std::string_view name, std::int32_t number, Nanoseconds time_ns);
    void tell_of_missing();
    void click(std::size_t wand, std::uint32_t button, bool pressed, Nanoseconds time_ns);

    std::string where_;
    TrackerBodies bodies_;
    TrackerInbox& to_;
    Body head_;
    std::array<Body, kTrackedWands> wands_;
    std::array<std::uint32_t, kTrackedWands> pressed_{};
    std::array<Vec2, kTrackedWands> sticks_{};
    // Bodies that have been reported, tracked or not, and since when there are any.
    std::vector<TrackedSource> seen_;
    ServerDelay delay_;
    std::optional<Nanoseconds> first_seen_ns_;
    bool told_of_missing_ = false;
};

}  // namespace burin::devices
