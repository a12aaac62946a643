// SPDX-License-Identifier: MIT
// Log of what the threads of a live session did, beside its input: enough to repeat it on one thread. The lines are
// described in docs/formats.md, "What the threads did".
//
//   a tick    what it read from the device, and which surface and parameters it saw. As lines of a text log, of one
//             hand with one part; a session file has the ticks of all parts in its columns (tick_source.hpp)
//   an update when the scene's service made it, up to which tick of each hand, how many orders it took
//   a frame   the tick whose tool it drew, the scene's updates it had taken, the sizes of its outputs, and the messages
//             from outside
// ThreadReplay (thread_replay.hpp) repeats ticks and updates.
//
// All times are on the session's clock, whose value at the start is kept too: a replay has the same times to the bit.
// Pure data and text; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "devices/haptic/device_sample.hpp"
#include "scene/scene_update.hpp"
#include "session/record/panel_measured.hpp"
#include "wall/output_settings.hpp"

namespace burin::session {

struct TickSeen {
    Nanoseconds time_ns = 0;
    devices::DeviceSample sample;
    std::uint64_t surface_sequence = 0, parameter_sequence = 0;
    bool late = false;
    std::optional<Nanoseconds> lateness_ns = {};  // where it is known to the nanosecond
};

// Position and size of a screen's output, from this frame on.
struct OutputSeen {
    std::size_t screen = 0;
    wall::OutputPlace place;
};

struct FrameSeen {
    std::vector<std::uint64_t> ticks{0};    // the newest that was finished, of each part of the hands; 0: none yet
    std::uint64_t updates = 0;              // of the scene, whose results it had taken
    std::uint64_t check = 0;                // checksum of the resulting state (SessionCheck)
    std::optional<std::uint64_t> activity;  // Activity::check(); none: nothing was kept of it
    std::vector<OutputSeen> outputs;
    PanelMeasured measured;
    // The mode that the main screen fell back to while the frame was drawn.
    std::optional<wall::StereoMode> refused;
    // Messages from outside the session, after the frame's own messages.
    std::vector<std::string> messages;
    std::size_t line = 0;
};

// Clock, device resolution and machine that a session's ticks were recorded with.
struct ThreadClock {
    Nanoseconds start_ns = 0;   // when the session's time began
    Nanoseconds period_ns = 1;  // of ticks
    // Step of most recorded positions; 0: unknown.
    double resolution_m = 0.0;
    double pace = 1.0;  // of the machine (haptics::WorkSettings): a replay's ticks do as much work as these did
    friend bool operator==(const ThreadClock&, const ThreadClock&) = default;
};

// Ticks or updates as lines of the file: checked once when the log is read, and parsed again when they are needed. An
// hour has millions of them.
struct ThreadLines {
    struct Line {
        std::size_t number = 0;
        std::string text;
    };
    std::vector<Line> lines;
    std::size_t count = 0;  // of ticks or updates
};

struct ThreadLog {
    ThreadClock clock;
    ThreadLines ticks, updates;                // from the first on; no ticks: they are in columns
    std::vector<std::string> messages_before;  // from outside, before the first frame
    std::vector<FrameSeen> frames;             // finished frames
    std::optional<std::uint64_t> end_check;
};

// ---- Text: ticks and updates as differences from the previous one

// Writes and reads ticks with the same state; start with the clock.
class TickText {
public:
    explicit TickText(const ThreadClock& clock);
    void write(std::string& text, const TickSeen& tick);
    // Reads one tick off the front of the text; nothing where there is none.
    [[nodiscard]] std::optional<TickSeen> read(std::string_view& text);

private:
    [[nodiscard]] std::int64_t steps(double position_m) const;
    [[nodiscard]] bool is_steps(double position_m) const;

    ThreadClock clock_;
    TickSeen last_;
};

class UpdateText {
public:
    explicit UpdateText(const ThreadClock& clock) : start_ns_(clock.start_ns) { last_.time_ns = clock.start_ns; }
    void write(std::string& text, const scene::SceneUpdate& update);
    // Returns an update of as many hands and parts as the text has named so far.
    [[nodiscard]] std::optional<scene::SceneUpdate> read(std::string_view& text);

private:
    Nanoseconds start_ns_;
    scene::SceneUpdate last_;
};

// Reads ticks or updates one after the other.
template <typename Text>
class ThreadLinesReader {
public:
    // The log must outlive it.
    ThreadLinesReader(const ThreadClock& clock, const ThreadLines& lines) : text_(clock), lines_(lines) {}
    // Returns the next one; nothing after the last.
    [[nodiscard]] auto next() {
        while (rest_.empty() && next_line_ < lines_.lines.size()) rest_ = lines_.lines[next_line_++].text;
        return text_.read(rest_);
    }
    // Returns the number of the line that held the last one.
    [[nodiscard]] std::size_t line() const { return next_line_ == 0 ? 0 : lines_.lines[next_line_ - 1].number; }

private:
    Text text_;
    const ThreadLines& lines_;
    std::size_t next_line_ = 0;
    std::string_view rest_;
};

// ---- Lines, without their time

inline constexpr std::size_t kMostTicksALine = 500;

[[nodiscard]] std::string text_of(const ThreadClock& clock);
[[nodiscard]] std::string text_of(const OutputSeen& output);
[[nodiscard]] std::string text_of(const PanelPlotted& plotted);
[[nodiscard]] std::string text_of(const PanelNumbers& numbers);
// Formats a frame without outputs, measured times, refused mode and messages, which have lines of their own.
[[nodiscard]] std::string text_of(const FrameSeen& frame);
[[nodiscard]] std::string activity_text(std::uint64_t check);
[[nodiscard]] std::string kept_text(std::uint64_t acknowledged);
[[nodiscard]] std::string refused_text(wall::StereoMode mode);
[[nodiscard]] std::string message_text(const std::string& message);
[[nodiscard]] std::string end_text(std::uint64_t check);

// Assembles a ThreadLog from the lines of a file.
class ThreadLogReader {
public:
    // Returns whether lines of this kind belong to the thread log.
    [[nodiscard]] static bool knows(std::string_view kind);
    // Takes a line. words: all of its words, from the kind on.
    [[nodiscard]] Result<void> take(const std::vector<std::string>& words, std::size_t line, const std::string& where);
    void frame_begins() { ++begun_; }
    // Returns the log; nothing when there was no such line.
    [[nodiscard]] std::optional<ThreadLog> finish() { return std::move(log_); }

private:
    [[nodiscard]] bool take_clock(const std::vector<std::string>& words);
    [[nodiscard]] bool take_saw(const std::vector<std::string>& words, std::size_t line);
    [[nodiscard]] bool take_output(const std::vector<std::string>& words);
    [[nodiscard]] bool take_plotted(const std::vector<std::string>& words);
    [[nodiscard]] bool take_figures(const std::vector<std::string>& words);
    [[nodiscard]] bool take_rest(const std::vector<std::string>& words);

    std::optional<ThreadLog> log_;
    std::optional<TickText> ticks_;
    std::optional<UpdateText> updates_;
    std::size_t begun_ = 0;  // number of frames begun
    FrameSeen frame_;        // its `saw` line has not come yet
};

}  // namespace burin::session
