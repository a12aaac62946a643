// SPDX-License-Identifier: MIT
#include "app/session/session_head.hpp"

#include "renderer/stereo/projection.hpp"

namespace burin {
namespace {

Pose operator*(const Pose& c_from_b, const Pose& b_from_a) {
    return {c_from_b * b_from_a.position_m, glm::normalize(c_from_b.orientation * b_from_a.orientation)};
}

Pose in_tracker(const WallSetup& setup, const Pose& world) {
    const Quat tracker_from_world = glm::conjugate(setup.world_from_tracker.orientation);
    return Pose{tracker_from_world * -setup.world_from_tracker.position_m, tracker_from_world} * world;
}

// The same eyes at another distance from each other.
SensorEyes spread(const SensorEyes& eyes, double distance_m) {
    const Vec3 middle = 0.5 * (eyes.left_sensor + eyes.right_sensor);
    const Vec3 half = 0.5 * (eyes.right_sensor - eyes.left_sensor);
    const double now_m = 2.0 * glm::length(half);
    const Vec3 wanted = now_m > 0.0 ? half * (distance_m / now_m) : Vec3(0.5 * distance_m, 0.0, 0.0);
    return {middle - wanted, middle + wanted};
}

}  // namespace

double interpupillary_m(const SensorEyes& eyes) { return glm::length(eyes.right_sensor - eyes.left_sensor); }

DisplayTiming timing_in(const WallSetup& setup, StereoMode mode) {
    DisplayTiming timing = setup.timing;
    if (mode == StereoMode::frame_sequential) timing.eye_order = EyeOrder::simultaneous;
    return timing;
}

SessionHead follow_head(SessionHead head, const WallSetup& setup, const DisplayTiming& timing,
                        std::span<const InputEvent> events, Nanoseconds display_ns, const Pose& flown_world) {
    const HeadSettings settings = head_settings(setup);
    for (const InputEvent& event : events) {
        const auto* said = std::get_if<HeadInput>(&event.input);
        if (said == nullptr || !said->tracked) continue;  // silence is noticed by itself
        head.tracked = true;
        head.track = take(settings, head.track, {event.time_ns, in_tracker(setup, said->pose_world)});
    }
    if (!head.tracked) {
        const Pose flown = in_tracker(setup, flown_world);
        head.poses = {flown, flown};
        return head;
    }
    DrawnHead drawn = draw(settings, head.track, eye_times(timing, display_ns));
    head.track = drawn.track;
    head.poses = drawn.poses;
    return head;
}

Pose head_world(const WallSetup& setup, const SessionHead& head) {
    return setup.world_from_tracker * head.poses.left_tracker;
}

Sight sight_of(const WallSetup& setup, std::size_t screen, const SessionHead& head, double distance_m) {
    WallSetup seen = setup;
    seen.eyes = spread(setup.eyes, distance_m);
    const Eyes eyes = eyes_world(seen, head.poses);
    Sight sight;
    sight.screen = screen_world(setup, setup.screens[screen]);
    sight.viewer = viewer_with(eyes, head_world(setup, head).orientation);
    sight.visible = can_be_seen(sight.screen, eyes);
    return sight;
}

}  // namespace burin
