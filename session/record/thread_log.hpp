// SPDX-License-Identifier: MIT
// What the threads of a live session did, beside its input: enough to do the same again on one thread. The lines are described in
// docs/formats.md, "What the threads did".
//
//   a tick    what it read of the device, and which surface and parameters it saw
//   an update of the carving side: when, up to which tick, how many orders; ThreadReplay (thread_replay.hpp) does both again
//   a frame   the tick whose tool it drew, the updates whose news it had, the sizes of its outputs, what it was told from outside
//
// All times are on the session's clock, whose present at the start is kept too: a replay has the same times to the bit.
// Pure data and text; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/session/carving_desk.hpp"
#include "app/session/panel_feed.hpp"
#include "base/error.hpp"
#include "devices/haptic_device.hpp"
#include "renderer/output/output_settings.hpp"

namespace burin {

struct TickSeen {
    Nanoseconds time_ns = 0;
    DeviceSample sample;
    std::uint64_t surface_sequence = 0, parameter_sequence = 0;
    bool late = false;
};

// Where a screen's output is, from this frame on.
struct OutputSeen {
    std::size_t screen = 0;
    OutputPlace place;
};

struct FrameSeen {
    std::uint64_t tick = 0;     // the newest that was done; 0: none yet
    std::uint64_t updates = 0;  // of the carving side, whose news it had
    std::uint64_t check = 0;    // of what came of all that (SessionCheck)
    std::vector<OutputSeen> outputs;
    PanelMeasured measured;
    std::optional<StereoMode> refused;  // the main screen went back to this mode while the frame was drawn
    std::vector<std::string> said;      // to people, by what is outside of the session; after the frame's own messages
    std::size_t line = 0;
};

// The clock and the device that a session's ticks went by.
struct ThreadClock {
    Nanoseconds start_ns = 0;   // when the session's time began
    Nanoseconds period_ns = 1;  // of ticks
    double resolution_m = 0.0;  // in whose steps positions are mostly told; 0: unknown
    friend bool operator==(const ThreadClock&, const ThreadClock&) = default;
};

// Ticks or updates as they stand in the file: read whole once, to see that they can be, and again when they are wanted. An hour has
// millions of them.
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
    ThreadLines ticks, updates;            // from the first on
    std::vector<std::string> said_before;  // the first frame
    std::vector<FrameSeen> frames;         // those that were finished
    std::optional<std::uint64_t> end_check;
};

// ---- Text: ticks and updates as differences from the one before

// Both ways alike; start with the clock.
class TickText {
public:
    explicit TickText(const ThreadClock& clock);
    void write(std::string& text, const TickSeen& tick);
    // Takes one tick off the text; nothing where there is none.
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
    void write(std::string& text, const UpdateSeen& update);
    [[nodiscard]] std::optional<UpdateSeen> read(std::string_view& text);

private:
    Nanoseconds start_ns_;
    UpdateSeen last_;
};

// Reads them one after the other.
template <typename Text>
class ThreadLinesReader {
public:
    // The log must outlive it.
    ThreadLinesReader(const ThreadClock& clock, const ThreadLines& lines) : text_(clock), lines_(lines) {}
    // Nothing after the last.
    [[nodiscard]] auto next() {
        while (rest_.empty() && next_line_ < lines_.lines.size()) rest_ = lines_.lines[next_line_++].text;
        return text_.read(rest_);
    }
    // In which the last one stood.
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
// All but outputs, what was measured, refused and said, which have lines of their own.
[[nodiscard]] std::string text_of(const FrameSeen& frame);
[[nodiscard]] std::string refused_text(StereoMode mode);
[[nodiscard]] std::string said_text(const std::string& message);
[[nodiscard]] std::string end_text(std::uint64_t check);

// Puts the lines of a log together.
class ThreadLogReader {
public:
    // Whether a line of this kind is one of these.
    [[nodiscard]] static bool knows(std::string_view kind);
    // words: all of the line's, from the kind on.
    [[nodiscard]] Result<void> take(const std::vector<std::string>& words, std::size_t line, const std::string& where);
    void frame_begins() { ++begun_; }
    // Nothing when there was no such line.
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
    std::size_t begun_ = 0;  // frames
    FrameSeen frame_;        // whose `saw` has not come yet
};

}  // namespace burin
