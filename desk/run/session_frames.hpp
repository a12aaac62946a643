// SPDX-License-Identifier: MIT
// The frames of a session: input -> step -> surface update -> recorder -> picture, the same in all kinds of session.
// Who decides about the frames differs: a user and the display (real_time_session.cpp), a script (ScriptedFrames), or a
// recording (recorded_session.cpp). All of it on the frame's thread.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "desk/live/desk.hpp"
#include "desk/present/frame_output.hpp"
#include "session/drive/driver.hpp"
#include "session/drive/end_signals.hpp"
#include "session/drive/thread_recorder.hpp"
#include "session/record/input_source.hpp"

namespace burin::session {

// Makes a frame but for its picture: steps the session with the input and hands it what the scene's parts report.
// places: where the outputs of all screens are.
[[nodiscard]] Result<void> step_frame(Desk& desk, Executor& executor, ThreadRecorder& recorder, const FrameInput& input,
                                      const std::vector<wall::OutputPlace>& places);

class SessionFrames : public FrameSource {
public:
    // Hands the session the surface as it was loaded. Session and output must outlive it. Create it before the
    // executor starts threads, which it records if the input is recorded.
    SessionFrames(Desk& desk, FrameOutput& output, InputSource input);

    [[nodiscard]] std::optional<Nanoseconds> next() final;
    [[nodiscard]] Result<void> make(Executor& executor) final;
    // Takes what was done after the last frame, when the executor has stopped, and ends the recording.
    [[nodiscard]] Result<void> finish(Executor& executor);
    // Returns whether a signal has ended the session before its log.
    [[nodiscard]] bool cut_short() const { return cut_short_; }
    // Streams what happens, and tells what there is to tell of it; null: nothing. They must outlive it.
    void stream_to(LslStreams* streams) {
        streams_ = streams;
        recorder_.stream_to(streams);
    }

protected:
    // Returns the next frame's input; nothing at the end. Waits for it in real time, and has the output look where it
    // is.
    [[nodiscard]] virtual std::optional<FrameInput> next_input() = 0;
    // Looks for a signal, and reports that what follows in the log is lost by it.
    [[nodiscard]] bool look_for_signal();
    // Called after the frame's step, before its picture.
    virtual void stepped() {}
    // Asked before each attempt to draw the frame; where the device was lost meanwhile there is another one.
    [[nodiscard]] virtual bool wants_picture() = 0;
    // Called at the frame's end. anew: whether there was anything new to draw.
    virtual void finished(const FrameInput&, [[maybe_unused]] bool anew) {}

    Desk& desk_;
    Session& session_;  // the desk's
    FrameOutput& shown_on_;
    InputSource input_;
    ThreadRecorder recorder_;
    LslStreams* streams_ = nullptr;
    EndSignals end_;

private:
    [[nodiscard]] Result<bool> draw(Executor& executor);
    void tell_of_late_input();
    void tell_of_what_follows();

    FrameInput frame_;
    bool cut_short_ = false;
};

// The frames of a script: each at the time that the input gives it. Events of windows are ignored.
class ScriptedFrames : public SessionFrames {
public:
    // Pictures depend on the script alone.
    ScriptedFrames(Desk& desk, FrameOutput& output, InputSource input) : SessionFrames(desk, output, std::move(input)) {
        session_.log().hear_nothing_from_outside();
    }

protected:
    [[nodiscard]] std::optional<FrameInput> next_input() override;
    void stepped() override;
    // Without an output, only frames that become screenshots are drawn.
    [[nodiscard]] bool wants_picture() override { return shown_on_.shows() || session_.files().wants_pictures(); }
};

}  // namespace burin::session
