// SPDX-License-Identifier: MIT
// Records what the threads of a live session do into the recording of its input (thread_log.hpp). Ticks come from the
// haptic thread's ring of records, which that thread fills as always: it knows nothing of a recording. Into a text file
// this class writes them; a session file's writer reads the ring itself (session/record/session_recording.hpp).
//
//   each frame: outside(), begin_frame ... step, take_updates, frame(), draw
//   after the threads have ended: finish()
//
// Recording ends, with the reason in the InputSource, when a tick is missing: the frame's thread was stalled for longer
// than the ring holds, or the scene's service did not take a sample. One thread, the frame's.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "scene/scene_update.hpp"
#include "session/activity/activity_marks.hpp"
#include "session/record/session_check.hpp"
#include "session/record/thread_log.hpp"
#include "wall/output_settings.hpp"
#include "wall/stereo_mode.hpp"

namespace burin::haptics {
struct ToolState;  // haptics/tool_state.hpp
}  // namespace burin::haptics

namespace burin::session {

class InputSource;       // session/record/input_source.hpp
class LslStreams;        // session/stream/lsl_streams.hpp
struct PanelMeasured;    // session/record/panel_measured.hpp
class Session;           // session/live/session.hpp
class SessionRecording;  // session/record/session_recording.hpp

// Returns the checksum of what the session leaves: the carved surface, and where the world's objects are. A recording
// keeps it at its end.
[[nodiscard]] std::uint64_t check_of(const Session& session);

[[nodiscard]] ThreadClock clock_of(Session& session);

// What a frame's viewer has, which a recording keeps with it.
struct FrameOfViewer {
    const std::vector<wall::OutputPlace>& places;  // of all screens' outputs
    const PanelMeasured& measured;
    const StateWords& words;
};

class ThreadRecorder {
public:
    // Create it before the threads start; input and session must outlive it. Does nothing where the input is not
    // recorded.
    ThreadRecorder(InputSource& input, Session& session);

    // Records the outside messages since the previous frame, and the stereo mode that was gone back to. Reports, once,
    // why the recording has ended.
    void outside(std::optional<wall::StereoMode> refused = {});
    // Records a frame. tools: those that the frame draws, one of each part of the hands. updates: those that it took.
    void frame(std::span<const haptics::ToolState> tools, const std::vector<scene::SceneUpdate>& updates,
               const FrameOfViewer& viewer);
    // Returns the last tick that a session file has on the disk, and whether the recording goes on; nothing without
    // such a file.
    struct Kept {
        std::uint64_t acknowledged = 0;
        bool goes_on = true;
    };
    [[nodiscard]] std::optional<Kept> kept() const;
    // Ends the recording, and closes a session file.
    void finish(const std::vector<scene::SceneUpdate>& updates);
    // Returns the trials and events that no session file has taken, since the last call. Events are kept where
    // keep_events() has been called.
    [[nodiscard]] std::vector<TrialMark> take_trials() { return std::exchange(trials_, {}); }
    [[nodiscard]] std::vector<EventMark> take_events() { return std::exchange(events_, {}); }
    void keep_events() { keeps_events_ = true; }
    // Streams trials and events from now on, and keeps the markers that are heard.
    void stream_to(LslStreams* streams) { streams_ = streams; }

private:
    void write_notes();
    void write_ticks();
    void write_ticks(const std::vector<TickSeen>& ticks);
    void write_updates(const std::vector<scene::SceneUpdate>& updates);
    void write_places(const std::vector<wall::OutputPlace>& places);

    InputSource& input_;
    Session& session_;
    ThreadClock clock_;
    TickText tick_text_;
    UpdateText update_text_;
    std::uint64_t ticks_ = 0, updates_ = 0;  // written so far
    std::vector<wall::OutputPlace> places_;
    std::vector<TrialMark> trials_;  // in no file, nor are
    std::vector<EventMark> events_;
    bool keeps_events_ = false;
    std::uint64_t activity_ = 0;  // its check, as written last
    SessionCheck check_;
    std::shared_ptr<SessionRecording> file_;  // null: a text file, or nothing
    bool recording_;
    LslStreams* streams_ = nullptr;  // null: there are none
};

}  // namespace burin::session
