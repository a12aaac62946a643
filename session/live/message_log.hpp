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

class MessageLog {
public:
    // Logs a message that follows from the input.
    void notify(const std::string& message) {
        newest_ = message;
        std::fprintf(stderr, "burin: %s\n", message.c_str());
    }
    // Logs a message from outside the session: from windows, files, trackers or the system. In a session that replays a
    // recording the panel shows the recorded ones instead (replay_events).
    void notify_of_event(const std::string& message) {
        if (!follows_recording_) newest_ = message;
        std::fprintf(stderr, "burin: %s\n", message.c_str());
        events_.push_back(message);
    }
    void replay_events(std::span<const std::string> recorded) {
        follows_recording_ = true;
        if (!recorded.empty()) newest_ = recorded.back();
    }
    // Returns the messages from outside since the last call, for the recorder.
    [[nodiscard]] std::vector<std::string> take_events() { return std::exchange(events_, {}); }
    [[nodiscard]] const std::string& newest() const { return newest_; }

private:
    std::string newest_;
    bool follows_recording_ = false;
    std::vector<std::string> events_;
};

}  // namespace burin::session
