// SPDX-License-Identifier: MIT
// Who looks at a session: the head that a tracker reports, or, as long as none has, the head that keys fly; and what each screen shows
// that head. Pure functions; any thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/session/input_event.hpp"
#include "app/session/session_screens.hpp"
#include "renderer/stereo/comfort.hpp"
#include "renderer/stereo/head.hpp"

namespace burin {

// The sensor on the head. Start with {}.
struct SessionHead {
    HeadTrack track;
    bool tracked = false;  // a tracker has been heard
    HeadPoses poses;       // at the times when the eyes' pictures are shown
};

// When each eye sees a frame: as the wall file says; but where the session itself shows the eyes by turns, each turn has a frame of its
// own, made for its own time.
[[nodiscard]] DisplayTiming timing_in(const WallSetup& setup, StereoMode mode);

// Takes what a tracker said, and predicts to the frame's display time. flown_world: the head that keys fly.
[[nodiscard]] SessionHead follow_head(SessionHead head, const WallSetup& setup, const DisplayTiming& timing,
                                      std::span<const InputEvent> events, Nanoseconds display_ns,
                                      const Pose& flown_world);

// The head's pose in the room, for what does not care about eyes: at the left one's time.
[[nodiscard]] Pose head_world(const WallSetup& setup, const SessionHead& head);

// What to draw for one screen.
struct Sight {
    Screen screen;
    Viewer viewer;
    bool visible = true;  // false: an eye is not in front of it; it stays dark
};
[[nodiscard]] Sight sight_of(const WallSetup& setup, std::size_t screen, const SessionHead& head,
                             double interpupillary_m);

// The distance between the eyes that a setup gives.
[[nodiscard]] double interpupillary_m(const SensorEyes& eyes);

}  // namespace burin
