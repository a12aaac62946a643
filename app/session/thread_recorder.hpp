// SPDX-License-Identifier: MIT
// Writes what the threads of a live session do into the recording of its input (thread_log.hpp). Ticks come by the haptic thread's ring of
// records, which it fills as always: it knows nothing of a recording.
//
//   outside()  begin_frame ... step, take_news  frame()  draw      each frame;  finish() after the threads have ended
//
// Recording ends, with the reason in the InputSource, when a tick is missing: the frame's thread stood still for longer than the ring holds,
// or the carving side did not take a sample. One thread, the frame's.
#pragma once

#include "app/session/input_source.hpp"
#include "app/session/live_session.hpp"
#include "app/session/session_check.hpp"
#include "app/session/thread_log.hpp"

namespace burin {

class ThreadRecorder {
public:
    // Before the threads start. Both must outlive it. Where the input is not recorded it does nothing.
    ThreadRecorder(InputSource& input, LiveSession& session);

    // What was heard from outside since the frame before. Says why the recording has ended, once.
    void outside();
    // tick: whose tool the frame draws. updates: that it took.
    void frame(std::uint64_t tick, const std::vector<UpdateSeen>& updates, const std::vector<OutputPlace>& places);
    void finish(const std::vector<UpdateSeen>& updates);

private:
    void write_ticks();
    void write_ticks(const std::vector<TickSeen>& ticks);
    void write_updates(const std::vector<UpdateSeen>& updates);
    void write_places(const std::vector<OutputPlace>& places);

    InputSource& input_;
    LiveSession& session_;
    ThreadClock clock_;
    TickText tick_text_;
    UpdateText update_text_;
    std::uint64_t ticks_ = 0, updates_ = 0;  // written
    std::vector<OutputPlace> places_;
    SessionCheck check_;
    bool recording_;
};

}  // namespace burin
