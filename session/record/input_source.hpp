// SPDX-License-Identifier: MIT
// Source of a session's input: a window and trackers, recorded if wanted, or a log. The session asks for each frame's
// input and cannot tell the difference:
//
//   while (const auto frame = input.begin_frame(now_ns, display_ns)) {
//       step everything to frame->time_ns with frame->events; draw
//   }
//
// The session must take all times of what it shows from the FrameInput, never from a clock. One thread.
#pragma once

#include <optional>
#include <span>

#include "session/record/input_log.hpp"

namespace burin::session {

struct FrameInput {
    Nanoseconds time_ns = 0;     // not before that of the previous frame
    Nanoseconds display_ns = 0;  // the time that heads are predicted to
    // Since the previous frame, none later than time_ns; no FrameStart among them.
    std::span<const InputEvent> events;
};

// Returns when the head of a frame was sampled: by the tracker, or now where keys and mouse steer it, since these were
// read just before.
[[nodiscard]] Nanoseconds head_sampled_ns(const FrameInput& frame);

class InputSource {
public:
    [[nodiscard]] static InputSource live(std::optional<InputLogWriter> recorder = std::nullopt);
    // Replays a log in simulated time. A log with FrameStart events gives exactly those frames; what comes after the
    // last was not seen when it was recorded either. A log without them (written by hand) gives a frame every period
    // from time 0 until the first that has seen its last event, each shown when it is drawn. period_ns > 0.
    [[nodiscard]] static InputSource replay(InputLog log, Nanoseconds period_ns = kNanosecondsPerSecond / 60);

    // Plays a log in real time, as if its user were there: each event is seen by the first frame that begins at its
    // time or later, but what comes after the command for a screenshot is seen by the next frame, so that the picture
    // shows what was asked for on slow machines too. FrameStart events are left out, since a recording's frames are not
    // those that are made now. What trackers report meanwhile is put among them by its time. Recorded if wanted, as
    // live input is.
    [[nodiscard]] static InputSource play(InputLog log, std::optional<InputLogWriter> recorder = std::nullopt);
    // Records all input from now on; to be called before the first frame.
    void record_to(InputLogWriter recorder) { recorder_ = std::move(recorder); }

    // Returns whether the log sets the time.
    [[nodiscard]] bool replays() const { return kind_ == Kind::replay; }
    // Returns, for play(), when the next event is due, so that a sleeping thread wakes for it; nothing otherwise.
    [[nodiscard]] std::optional<Nanoseconds> next_event_ns() const;

    // Adds a live input that arrived now; keeps times non-decreasing. Input that is not sensible is dropped and
    // counted. Of these a log that is played takes what trackers report and what a device's keys ask for
    // (is_of_device), and one that is replayed nothing: the log is all the input there is.
    void push(Nanoseconds now_ns, Input input, bool is_of_device = false);

    // Returns all input for the next frame; nothing when a log is over. Live and in real time the frame is now; a
    // replay ignores now_ns and display_ns. The events are borrowed until the next call.
    [[nodiscard]] std::optional<FrameInput> begin_frame(Nanoseconds now_ns, Nanoseconds display_ns);

    // Record, in real time, a line of what the threads did (session/record/thread_log.hpp), and end the recording for a
    // reason.
    [[nodiscard]] bool records() const { return recorder_.has_value(); }
    void record_threads(const std::string& text);
    // Records what a frame saw into a session file.
    void record_frame(const FrameSeen& frame, const StateWords& state);
    // The session file that is recorded; null: none, or a text file.
    [[nodiscard]] std::shared_ptr<SessionRecording> recording() const {
        return recorder_ ? recorder_->recording() : nullptr;
    }
    void stop_recording(Error why);

    // Returns by how much the latest event of a log that is played was taken after its time, so far: frames that take
    // long come late. 0 where the log sets the time.
    [[nodiscard]] Nanoseconds latest_by_ns() const { return latest_by_ns_; }

    // Returns the first command of a log written by hand that no frame has taken yet; null: there is none.
    [[nodiscard]] const InputEvent* next_command() const;

    // Returns, for live input, whether events are waiting for a frame.
    [[nodiscard]] bool has_waiting_input() const { return !waiting_.empty(); }
    [[nodiscard]] std::uint64_t refused() const { return refused_; }
    // Returns why recording ended before the session; nothing while there is no error.
    [[nodiscard]] const std::optional<Error>& recording_error() const { return recording_error_; }

private:
    void record(const InputEvent& event);
    [[nodiscard]] std::optional<FrameInput> played_frame(Nanoseconds now_ns, Nanoseconds display_ns);
    [[nodiscard]] FrameInput live_frame(Nanoseconds now_ns, Nanoseconds display_ns);
    [[nodiscard]] std::optional<FrameInput> recorded_frame();
    [[nodiscard]] std::optional<FrameInput> made_up_frame();

    enum class Kind : std::uint8_t { live, replay, play };
    Kind kind_ = Kind::live;
    std::optional<InputLogWriter> recorder_;
    std::optional<Error> recording_error_;
    std::uint64_t refused_ = 0;
    Nanoseconds last_ns_ = 0, latest_by_ns_ = 0;
    std::vector<InputEvent> waiting_, taken_;

    InputLog log_;
    std::size_t next_ = 0;  // index of the log's next event
    bool log_has_frames_ = false;
    Nanoseconds period_ns_ = 0, next_frame_ns_ = 0;
    bool over_ = false;
};

}  // namespace burin::session
