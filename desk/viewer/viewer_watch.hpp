// SPDX-License-Identifier: MIT
// Watches over who sees a session, and over the trackers: each looks at a frame's state, keeps what it saw before, and
// reports when something begins or ends. Thread: the frame's.
#pragma once

#include <optional>
#include <string>

#include "desk/viewer/viewer.hpp"
#include "haptics/tick_record.hpp"
#include "haptics/tool_state.hpp"
#include "wall/head_prediction.hpp"

namespace burin::session {

// Watches the parallax of what is drawn.
class ComfortWatch {
public:
    // Returns a warning when the parallax has gone beyond the viewer's budget.
    [[nodiscard]] std::optional<std::string> look(const ViewedSession& seen, const haptics::ToolState& tool);

private:
    bool strained_ = false;  // the last frame's parallax was beyond the budget
};

// Watches the head's tracker.
class TrackerWatch {
public:
    // Returns a message when the tracker has lost the head, or sees it again. time_ns: session time.
    [[nodiscard]] std::optional<std::string> look(const Viewer& viewer, const DeskRoom& desk, Nanoseconds time_ns);
    // Returns the last report; meaningless without a tracker.
    [[nodiscard]] const wall::TrackerReport& report() const { return report_; }

private:
    wall::TrackerReport report_;
};

// Watches whether wands are where they can be.
class WandWatch {
public:
    // Returns a message when a wand's tracker begins to have it farther away than any hall is long.
    [[nodiscard]] std::optional<std::string> look(const WandState& wands);

private:
    bool far_ = false;
};

// Watches whether a tracker speaks at all: one that sends elsewhere, or is off, is otherwise silent without a word.
class FirstWordWatch {
public:
    static constexpr Nanoseconds kPatience_ns = 5'000'000'000;
    explicit FirstWordWatch(std::string tracker) : tracker_(std::move(tracker)) {}
    // heard: something came since the last call. time_ns: on one clock, which begins with the first call. Returns a
    // message once, when nothing has ever come for kPatience_ns; and once more when something comes after all.
    [[nodiscard]] std::optional<std::string> look(bool heard, Nanoseconds time_ns);

private:
    std::string tracker_;  // as --tracker names it
    std::optional<Nanoseconds> begun_ns_;
    bool heard_ = false, told_ = false;
};

}  // namespace burin::session
