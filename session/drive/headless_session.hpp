// SPDX-License-Identifier: MIT
// Runs a session that nobody sees, in simulated time on the caller's thread, or in real time: what leads its hand is
// what an activity brings, and its frames only have the activity go on, with the input that whoever runs it gives.
// Recorded as a live session is, where no input is given, so that the same replay does it again; its frames have no
// viewer, which the recording says.
//
// Each frame, from the beginning on: plan(), for a hand that goes on by itself until then -> ticks and the scene's
// updates -> a step or several -> what the updates report -> the recorder. An activity so meets the ticks of an update
// in the step of the frame after it. The same inputs give the same bits; sessions of other threads share nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "record/record_writer.hpp"
#include "session/drive/recording_start.hpp"
#include "session/input/input_event.hpp"

namespace burin::haptics {
struct ToolState;  // haptics/tool_state.hpp
}

namespace burin::session {

class Session;  // session/live/session.hpp

// The fact of a session file by which its frames are known to have had no viewer, and its value then.
inline constexpr const char* kViewerFact = "viewer";
inline constexpr const char* kNoViewer = "none";

// A frame that is to be made.
struct HeadlessFrame {
    Nanoseconds time_ns = 0;                    // session time
    std::span<const haptics::ToolState> tools;  // of each part, as the last tick has left them
    // Carries out inputs, and has the next step know what the scene reports until now.
    std::function<Result<void>(std::span<const InputEvent>)> step;
};

struct HeadlessRun {
    Nanoseconds lasts_ns = 0;  // it ends with the first frame at that time or later; of no account where there is plan
    SessionFacts facts = {};   // of the session file, where the session's options name one
    std::int64_t frames_a_second = 100;
    // Is told the time of the next frame; returns whether there is one. Null: there is one until lasts_ns.
    std::function<bool(Nanoseconds time_ns)> plan = {};
    // Makes the frame with one step or several; null: one step without input. A session that it leads is not recorded.
    std::function<Result<void>(const HeadlessFrame&)> make_frame = {};
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

// Runs it to its end, which is its own or a command's. The clock is the session's. Fails where a session that is given
// input is to be recorded, where the session cannot go on, and as make_frame and after_frame do.
[[nodiscard]] Result<void> run_headless(Session& session, SimulatedClock& clock, const HeadlessRun& run);
// Runs it in real time from the start of its threads on, of haptic loop and scene, with the frames on the caller's.
// Returns what the system refused of real-time scheduling, in words (haptics::RealtimeNotice).
[[nodiscard]] Result<std::string> run_headless_in_real_time(Session& session, Clock& clock, const HeadlessRun& run);

}  // namespace burin::session
