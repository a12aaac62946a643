// SPDX-License-Identifier: MIT
// Messages of a live session. Each goes to standard error at once; those of a while ago can be read again. A message
// is shown over the picture for as long as its kind says, and counted when it is repeated meanwhile.
// Times are the session's, as the last begin_step() said, so that a replay shows the same. Thread: the frame's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "session/notices/message_kind.hpp"

namespace burin::session {

// Text that the terminal alone shows beside a message: the panel's pictures do not depend on it.
struct Beside {
    std::string before, after;
};

struct Message {
    std::string text;
    MessageKind kind = MessageKind::info;
    Nanoseconds time_ns = 0;  // when it was told last
    std::uint32_t count = 1;  // how often, while it was shown
    bool dismissed = false;
};

class MessageLog {
public:
    static constexpr std::size_t kKept = 100;
    // Time for which a message is shown, by kind; errors stay until they are dismissed.
    static constexpr Nanoseconds kInfo_ns = 5'000'000'000, kWarning_ns = 12'000'000'000;

    // Has messages from outside go to standard error alone: in simulated time pictures depend on the input alone.
    void hear_nothing_from_outside() { hears_outside_ = false; }
    // Has nothing written to standard error: whoever runs the session tells of it.
    void print_nothing() { prints_ = false; }
    void begin_step(Nanoseconds time_ns) { now_ns_ = time_ns; }
    // Logs a message that follows from the input.
    void notify(const std::string& message, MessageKind kind = MessageKind::warning, const Beside& beside = {});
    // Takes a message from outside the session: from windows, files, trackers or the system. It is logged between two
    // steps (take_events), so that a recording, which keeps no finer order, shows the same: a session that replays one
    // logs the recorded ones instead (replay_events).
    void notify_of_event(const std::string& message, MessageKind kind = MessageKind::info, const Beside& beside = {});
    void replay_events(std::span<const std::string> recorded);
    // Takes those that are shown off the picture; they stay in the log.
    void dismiss();

    // Returns whether messages from outside are a recording's.
    [[nodiscard]] bool follows_recording() const { return follows_recording_; }
    // Logs the messages from outside since the last call, and returns them for the recorder.
    [[nodiscard]] std::vector<std::string> take_events();
    // Returns all that are kept, the oldest first, and whether one is to be shown now.
    [[nodiscard]] const std::vector<Message>& all() const { return all_; }
    [[nodiscard]] bool is_shown(const Message& message) const;
    [[nodiscard]] std::string newest() const { return all_.empty() ? std::string() : all_.back().text; }
    // Counts what has changed of what is shown, but for what goes away by itself.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }
    // Returns when the next of those that are shown goes away by itself; none does: nothing.
    [[nodiscard]] std::optional<Nanoseconds> next_change_ns() const;

private:
    struct Heard {
        std::string message;
        MessageKind kind = MessageKind::info;
    };
    void keep(const std::string& message, MessageKind kind);
    void print(const std::string& message, const Beside& beside) const;

    std::vector<Message> all_;
    Nanoseconds now_ns_ = 0;
    std::uint64_t changes_ = 0;
    bool follows_recording_ = false, hears_outside_ = true, prints_ = true;
    std::vector<Heard> heard_;  // from outside, not logged yet
};

}  // namespace burin::session
