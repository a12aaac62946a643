// SPDX-License-Identifier: MIT
// Messages of a live session. Each goes to standard error at once and stands on the panel until the next one comes.
// Thread: the frame's.
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace burin::session {

// Text that the terminal alone shows beside a message: the panel's pictures do not depend on it.
struct Beside {
    std::string before, after;
};

class MessageLog {
public:
    // Logs a message that follows from the input.
    void notify(const std::string& message, const Beside& beside = {}) {
        newest_ = message;
        print(message, beside);
    }
    // Logs a message from outside the session: from windows, files, trackers or the system. In a session that replays a
    // recording the panel shows the recorded ones instead (replay_events).
    void notify_of_event(const std::string& message, const Beside& beside = {}) {
        if (!follows_recording_) newest_ = message;
        print(message, beside);
        events_.push_back(message);
    }
    void replay_events(std::span<const std::string> recorded) {
        follows_recording_ = true;
        if (!recorded.empty()) newest_ = recorded.back();
    }
    // Returns whether messages from outside are a recording's.
    [[nodiscard]] bool follows_recording() const { return follows_recording_; }
    // Returns the messages from outside since the last call, for the recorder.
    [[nodiscard]] std::vector<std::string> take_events() { return std::exchange(events_, {}); }
    [[nodiscard]] const std::string& newest() const { return newest_; }

private:
    static void print(const std::string& message, const Beside& beside) {
        std::fprintf(stderr, "burin: %s%s%s\n", beside.before.c_str(), message.c_str(), beside.after.c_str());
    }

    std::string newest_;
    bool follows_recording_ = false;
    std::vector<std::string> events_;
};

}  // namespace burin::session
