// SPDX-License-Identifier: MIT
#include "desk/view/session_tracker.hpp"

#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::session {
namespace {

// A wall's file may put the eyes elsewhere than at the head's sensor, or a tracker's description the sensor to the
// eyes; both together are a mistake.
Result<void> check_eyes(const DeskOptions& options, const SessionTracker& tracker, const wall::WallSetup& setup) {
    constexpr double kNoticeable_m = 1e-6;
    if (!tracker.described || !tracker.described->bodies.head) return {};
    const Vec3 middle = 0.5 * (setup.eyes.left_sensor + setup.eyes.right_sensor);
    const Pose& mount = tracker.described->bodies.head_mount.body_from_point;
    if (glm::length(middle) <= kNoticeable_m || glm::length(mount.position_m) <= kNoticeable_m) return {};
    return fail(tracker.described->file,
                "moves the head's point to the eyes, and " + options.wall +
                    formatted(" moves the eyes by %.3f m", glm::length(middle)) + " from there again",
                "leave position out of the tracker's [head], or let the wall's eyes be about the sensor: "
                "middle_of_eyes = [0, 0, 0]");
}

}  // namespace

Result<SessionTracker> session_tracker(const SessionSetup& options, const wall::WallSetup& setup) {
    const std::string& given = options.desk.tracker;
    const bool hears = options.record.input.empty() || !options.record.path.empty();
    if (given == kNoTracker || !hears) return SessionTracker{};
    SessionTracker tracker;
    if (given.ends_with(".toml")) {
        BURIN_TRY(read, devices::read_tracker(given));
        tracker.described = std::move(read);
    } else if (!options.desk.wall.empty() && !setup.tracker_toml.empty()) {
        BURIN_TRY(read, devices::tracker_of_wall(options.desk.wall));
        tracker.described = std::move(read);
        const bool is_of_its_kind = tracker.described && devices::tracker_kind_of(given) ==
                                                             devices::tracker_kind_of(tracker.described->address);
        if (!given.empty() && !is_of_its_kind) tracker.described.reset();
    }
    tracker.where =
        tracker.described && (given.empty() || given == tracker.described->file) ? tracker.described->address : given;
    BURIN_TRY_DO(check_eyes(options.desk, tracker, setup));
    return tracker;
}

Result<std::unique_ptr<devices::Tracker>> open_tracker(const SessionTracker& tracker, const wall::WallSetup& setup,
                                                       devices::TrackerHost host) {
    host.described = tracker.described ? &tracker.described->bodies : nullptr;
    host.world_from_tracker = setup.world_from_tracker;
    auto opened = devices::open_tracker(tracker.where, std::move(host));
    if (!opened && tracker.described)
        return fail(opened.error().where, opened.error().what,
                    opened.error().remedy + "; " + tracker.described->file + " names it: --tracker " + kNoTracker +
                        " does without");
    return opened;
}

}  // namespace burin::session
