// SPDX-License-Identifier: MIT
// Runs a session that nobody sees, in simulated time on the caller's thread: what leads its hand is a script that an
// activity brings, and its frames only have the activity go on. Recorded as a live session is, so that the same replay
// does it again; its frames have no viewer, which the recording says.
//
// Each frame, every 10 ms from the beginning on: ticks and the scene's update -> a step -> what the update reports ->
// the recorder. An activity so meets the ticks of an update in the step of the frame after it.
#pragma once

#include <functional>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "session/drive/recording_start.hpp"

namespace burin::session {

class Session;  // session/live/session.hpp

// The fact of a session file by which its frames are known to have had no viewer, and its value then.
inline constexpr const char* kViewerFact = "viewer";
inline constexpr const char* kNoViewer = "none";

struct HeadlessRun {
    Nanoseconds lasts_ns = 0;  // it ends with the first frame at that time or later
    SessionFacts facts = {};   // of the session file, where the session's options name one
    // Called after each frame, and once after the scene has ended; a failure ends the session. Null: nobody is.
    std::function<Result<void>()> after_frame = {};
};

// Runs it to its end. The clock is the session's.
[[nodiscard]] Result<void> run_headless(Session& session, SimulatedClock& clock, const HeadlessRun& run);

}  // namespace burin::session
