// SPDX-License-Identifier: MIT
// burin sculpt, live: a window that one carves in; or a script or a recording in its user's place.
//
// With a window and its user time is real: haptics and carving have threads of their own, and a frame is drawn when something has changed, as
// late as the display allows. With an input log time is simulated: ticks, carving and frames follow one another on one thread, so that
// the same log gives the same frames, in a window or without any. A recording (live.record) also holds what the threads did, and given as an
// input gives the frames that were seen. A log that is recorded takes its user's place in real time.
#pragma once

#include "app/sculpt.hpp"
#include "app/session/session_times.hpp"

namespace burin {

// Whether these options ask for a session instead of a stroke.
[[nodiscard]] bool wants_session(const SculptOptions& options);

[[nodiscard]] Result<void> run_session(const SculptOptions& options);

// The session of an input log in real time, with the threads and the loop of a live one, and what all of it took. In a window or
// without (options.live.offscreen). Commands of the log that write files are left out. for_a_device: ticks are as punctual as its user needs
// them; otherwise as those of a simulated hand, which may rest.
[[nodiscard]] Result<SessionRecord> time_session(const SculptOptions& options, bool for_a_device);

}  // namespace burin
