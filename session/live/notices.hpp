// SPDX-License-Identifier: MIT
// What a session tells of itself: messages to its user, what became of the files that were asked for, and events for
// the recording. The watches of session_watch.hpp look at each step for it. Thread: the frame's.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "session/live/asked_files.hpp"
#include "session/live/hand_side.hpp"
#include "session/live/session_watch.hpp"
#include "session/notices/message_log.hpp"

namespace burin::session {

class Notices {
public:
    explicit Notices(const SessionSetup& options) : files_(options, log_) {}

    [[nodiscard]] MessageLog& log() { return log_; }
    [[nodiscard]] const MessageLog& log() const { return log_; }
    [[nodiscard]] AskedFiles& files() { return files_; }
    [[nodiscard]] const AskedFiles& files() const { return files_; }

    // silent: does not say whether tool and workpiece suit one another.
    void begin(bool silent) { misfit_.begin(silent); }
    // Looks at strokes and devices after a step.
    void look(const SessionState& state, const SessionHands& hands, std::span<const haptics::ToolState> tools,
              const haptics::ToolState& in_use, const Led& led, double spacing_m, Nanoseconds time_ns);
    void look_at_tool(const toolbox::ToolSettings& settings, const toolbox::Tool& tool, const Box& workpiece_object,
                      double spacing_m);
    // Takes what has changed of the carved surface.
    void take(const scene::SurfaceUpdate& update);
    // Tells the user a step's messages; of what a log asked for and did not get with its line.
    void tell(const std::vector<Asked>& messages);

    // Tells what became of a switch of the amplifiers that a line of a log asked for; 0: a user did.
    void tell_of(const HandSide::Switched& amplifiers, std::size_t line);

    void add_event(EventMark event) { events_.push_back(std::move(event)); }
    void add_events(std::vector<EventMark> events) { std::ranges::move(events, std::back_inserter(events_)); }
    // Returns what has happened since the last call, for the table of events; every frame asks for it.
    [[nodiscard]] std::vector<EventMark> take_events() { return std::exchange(events_, {}); }
    // Returns when something is to be said without input, in session time; nothing: never.
    [[nodiscard]] std::optional<Nanoseconds> changes_ns() const;

private:
    MessageLog log_;
    AskedFiles files_;
    StrokeWatch strokes_;
    DeviceWatch devices_;
    MisfitWatch misfit_;
    std::vector<EventMark> events_;  // not taken yet
};

}  // namespace burin::session
