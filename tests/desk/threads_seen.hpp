// SPDX-License-Identifier: MIT
// Lets the frames of a test session wait for its threads, so that none is lost on a busy machine.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <thread>

#include "desk/live/desk.hpp"
#include "haptics/channels.hpp"
#include "session/drive/executors.hpp"
#include "tests/support/paced_clock.hpp"

namespace burin::session {

// How far the threads of a session have come, for a frame that waits for them.
class ThreadsSeen {
public:
    // most_behind: ticks by which scene or file may lag. A scene in which nothing moves rests for longer than a frame.
    ThreadsSeen(Session& session, PacedClock& clock, std::size_t most_behind)
        : session_(session), clock_(clock), most_behind_(most_behind) {}
    // On the scene's thread, after an update.
    void update_ended(const scene::SceneThread::Ended& ended) {
        static_cast<void>(session_.collect(ended));
        if (ended.failed) {
            failed_ = true;
            frames_end();
        }
    }
    // The frames sleep no more, and the hand's thread goes on until it is told to end.
    void frames_end() { clock_.go_on_in_real_time(); }
    // Waits for a frame's time outside, in which the scene makes its updates, and until neither the scene nor the file
    // is far behind the hand.
    void wait(Nanoseconds frame_ns) {
        std::this_thread::sleep_for(std::chrono::nanoseconds(frame_ns));
        const auto is_behind = [this](const haptics::HapticChannels* part) {
            return part->ticks.waiting() > most_behind_ || part->records.waiting() > most_behind_;
        };
        while (!failed_ && std::ranges::any_of(session_.channels_of_parts(), is_behind))
            std::this_thread::sleep_for(std::chrono::microseconds(200));
    }

private:
    Session& session_;
    PacedClock& clock_;
    const std::size_t most_behind_;
    std::atomic<bool> failed_ = false;
};

}  // namespace burin::session
