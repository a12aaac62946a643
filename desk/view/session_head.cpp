// SPDX-License-Identifier: MIT
#include "desk/view/session_head.hpp"

#include "wall/projection.hpp"

namespace burin::session {
namespace {

Pose operator*(const Pose& c_from_b, const Pose& b_from_a) {
    return {c_from_b * b_from_a.position_m, glm::normalize(c_from_b.orientation * b_from_a.orientation)};
}

Pose in_tracker(const wall::WallSetup& setup, const Pose& world) {
    const Quat tracker_from_world = glm::conjugate(setup.world_from_tracker.orientation);
    return Pose{tracker_from_world * -setup.world_from_tracker.position_m, tracker_from_world} * world;
}

// Returns the same eyes at another distance from each other.
wall::SensorEyes spread(const wall::SensorEyes& eyes, double distance_m) {
    const Vec3 middle = 0.5 * (eyes.left_sensor + eyes.right_sensor);
    const Vec3 half = 0.5 * (eyes.right_sensor - eyes.left_sensor);
    const double now_m = 2.0 * glm::length(half);
    const Vec3 wanted = now_m > 0.0 ? half * (distance_m / now_m) : Vec3(0.5 * distance_m, 0.0, 0.0);
    return {middle - wanted, middle + wanted};
}

}  // namespace

double interpupillary_m(const wall::SensorEyes& eyes) { return glm::length(eyes.right_sensor - eyes.left_sensor); }

wall::DisplayTiming timing_in(const wall::WallSetup& setup, wall::StereoMode mode) {
    wall::DisplayTiming timing = setup.timing;
    if (mode == wall::StereoMode::frame_sequential) timing.eye_order = wall::EyeOrder::simultaneous;
    return timing;
}

SessionHead follow_head(SessionHead head, const wall::WallSetup& setup, const wall::DisplayTiming& timing,
                        std::span<const InputEvent> events, Nanoseconds display_ns, const Pose& flown_world) {
    const wall::HeadSettings settings = wall::head_settings(setup);
    for (const InputEvent& event : events) {
        const auto* said = std::get_if<HeadInput>(&event.input);
        if (said == nullptr || !said->tracked) continue;  // loss of tracking is detected from the missing samples
        head.tracked = true;
        head.track = wall::take(settings, head.track, {event.time_ns, in_tracker(setup, said->pose_world)});
    }
    if (!head.tracked) {
        const Pose flown = in_tracker(setup, flown_world);
        head.poses = {flown, flown};
        return head;
    }
    wall::DrawnHead drawn = wall::draw(settings, head.track, wall::eye_times(timing, display_ns));
    head.track = drawn.track;
    head.poses = drawn.poses;
    return head;
}

Pose head_world(const wall::WallSetup& setup, const SessionHead& head) {
    return setup.world_from_tracker * head.poses.left_tracker;
}

View view_of(const wall::WallSetup& setup, std::size_t screen, const SessionHead& head, double distance_m) {
    wall::WallSetup seen = setup;
    seen.eyes = spread(setup.eyes, distance_m);
    const wall::Eyes eyes = wall::eyes_world(seen, head.poses);
    View sight;
    sight.screen = wall::screen_world(setup, setup.screens[screen]);
    sight.viewer = wall::viewer_with(eyes, head_world(setup, head).orientation);
    sight.visible = wall::can_be_seen(sight.screen, eyes);
    return sight;
}

}  // namespace burin::session
