// SPDX-License-Identifier: MIT
// Runs a session that nobody sees, in simulated time on the caller's thread, or in real time: what leads its hand is a
// script that an activity brings, and its frames only have the activity go on. Recorded as a live session is, so that
// the same replay does it again; its frames have no viewer, which the recording says.
//
// Each frame, every 10 ms from the beginning on: ticks and the scene's update -> a step -> what the update reports ->
// the recorder. An activity so meets the ticks of an update in the step of the frame after it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "record/record_writer.hpp"
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
    // It ends at lasts_ns itself, with a frame that comes earlier than those before it.
    bool ends_on_time = false;
    // Takes every tick of each part in order, those too that the scene has lost: on the writer's thread where a session
    // file is recorded, else on the frame's. Null: nobody does.
    record::OnRecord on_tick = {};
    // Has appended how long each tick took, in nanoseconds, where time is simulated; null: that is not measured.
    std::vector<std::uint32_t>* tick_ns = nullptr;
};

// Runs it to its end. The clock is the session's.
[[nodiscard]] Result<void> run_headless(Session& session, SimulatedClock& clock, const HeadlessRun& run);
// Runs it in real time from the start of its threads on, of haptic loop and scene, with the frames on the caller's.
// Returns what the system refused of real-time scheduling, in words (haptics::RealtimeNotice).
[[nodiscard]] Result<std::string> run_headless_in_real_time(Session& session, Clock& clock, const HeadlessRun& run);

}  // namespace burin::session
