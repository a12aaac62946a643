// SPDX-License-Identifier: MIT
// Tracks who looks at a session: the head that a tracker reports or, until one has reported, the head that keys fly;
// and computes what each screen shows that head. Pure functions; any thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "desk/view/session_screens.hpp"
#include "session/input/input_event.hpp"
#include "wall/comfort.hpp"
#include "wall/head_prediction.hpp"

namespace burin::session {

// State of the head and its tracker. Start with {}.
struct SessionHead {
    wall::HeadTrack track;
    bool tracked = false;   // a tracker has reported
    wall::HeadPoses poses;  // predicted to the times at which the eyes see their pictures
};

// Returns when each eye sees a frame: as the wall file says, except where the session itself alternates the eyes;
// there each turn is a frame of its own, made for its own time.
[[nodiscard]] wall::DisplayTiming timing_in(const wall::WallSetup& setup, wall::StereoMode mode);

// Applies the tracker's samples and predicts the head to the frame's display time. flown_world: the pose of the head
// that keys fly.
[[nodiscard]] SessionHead follow_head(SessionHead head, const wall::WallSetup& setup, const wall::DisplayTiming& timing,
                                      std::span<const InputEvent> events, Nanoseconds display_ns,
                                      const Pose& flown_world);

// Returns the head's pose in the world frame for uses that do not distinguish the eyes: predicted to the left eye's
// time.
[[nodiscard]] Pose head_world(const wall::WallSetup& setup, const SessionHead& head);

// View of one screen: what to draw, and from where.
struct View {
    wall::Screen screen;
    wall::Viewer viewer;
    bool visible = true;  // false: an eye is not in front of the screen, which stays dark
};
[[nodiscard]] View view_of(const wall::WallSetup& setup, std::size_t screen, const SessionHead& head,
                           double interpupillary_m);

// Returns the distance between the eyes of a setup.
[[nodiscard]] double interpupillary_m(const wall::SensorEyes& eyes);

}  // namespace burin::session
