// SPDX-License-Identifier: MIT
// Where a session's input comes from: a window and trackers, recorded if wanted, or a log. The session asks for a frame's input
// and cannot tell the difference:
//
//   while (const auto frame = input.begin_frame(now_ns, display_ns)) { step everything to frame->time_ns with frame->events; draw }
//
// It must take all times of what it shows from the FrameInput, never from a clock. One thread.
#pragma once

#include <optional>
#include <span>

#include "app/session/input_log.hpp"

namespace burin {

struct FrameInput {
    Nanoseconds time_ns = 0;             // not before that of the frame before
    Nanoseconds display_ns = 0;          // what heads are predicted to
    std::span<const InputEvent> events;  // since the frame before, none later than time_ns; no FrameStart among them
};

// When the head of a frame was sampled: by the tracker; or now, where keys and the mouse steer it, which were asked just before.
[[nodiscard]] Nanoseconds head_sampled_ns(const FrameInput& frame);

class InputSource {
public:
    [[nodiscard]] static InputSource live(std::optional<InputLogWriter> recorder = std::nullopt);
    // A log with FrameStart events gives those frames, and no more; what comes after the last was not seen when it was recorded
    // either. One without (written by hand) gives a frame every period from time 0 until the first that has seen its last event,
    // each shown when it is drawn. period_ns > 0.
    [[nodiscard]] static InputSource replay(InputLog log, Nanoseconds period_ns = kNanosecondsPerSecond / 60);

    // A log in real time, as if its user were there: each event is seen by the first frame that begins at its time or later, but what comes
    // after the command for a screenshot by the next frame, so that the picture shows what it was asked of on slow machines too. The
    // frames of a recording are not those that are made now, so FrameStart events are left out. Recorded if wanted, as live input is.
    [[nodiscard]] static InputSource play(InputLog log, std::optional<InputLogWriter> recorder = std::nullopt);

    // Whether time is the log's.
    [[nodiscard]] bool replays() const { return kind_ == Kind::replay; }
    // Of play(): when the next event is due, so that one who sleeps is there. Nothing otherwise.
    [[nodiscard]] std::optional<Nanoseconds> next_event_ns() const;

    // Live: an input arrived. Times are made not to fall. What is not sensible is passed over and counted. A log is all the input
    // there is: this does nothing then.
    void push(Nanoseconds now_ns, Input input);

    // All input for the next frame; nothing when a log is over. Live and in real time the frame is now; in a replay now_ns and
    // display_ns are not looked at. The events are borrowed until the next call.
    [[nodiscard]] std::optional<FrameInput> begin_frame(Nanoseconds now_ns, Nanoseconds display_ns);

    // In real time, while it is recorded: a line of what the threads did (thread_log.hpp), and the end of recording for a reason.
    [[nodiscard]] bool records() const { return recorder_.has_value(); }
    void record_threads(const std::string& text);
    void stop_recording(Error why);

    // Live: whether anything is waiting to be seen by a frame.
    [[nodiscard]] bool has_news() const { return !waiting_.empty(); }
    [[nodiscard]] std::uint64_t refused() const { return refused_; }
    // Why recording ended before the session; nothing while all is well.
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
    Nanoseconds last_ns_ = 0;
    std::vector<InputEvent> waiting_, taken_;

    InputLog log_;
    std::size_t next_ = 0;  // event of the log
    bool log_has_frames_ = false;
    Nanoseconds period_ns_ = 0, next_frame_ns_ = 0;
    bool over_ = false;
};

}  // namespace burin
