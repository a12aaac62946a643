// SPDX-License-Identifier: MIT
// What the frames of a live session take and how old what they show is, told by the loop that makes them as it goes:
//
//   begin()  wait -> reached(wait)  input -> reached(input)  step -> reached(step), sampled(), cut()
//            for each screen: reached(record)  reached(draw)  reached(show)      finished(drawn, beat)
//
// A stage lasts from what was reached before it; screens add up. When a frame is seen is an estimate: the display shows it from the
// next refresh on, and half a scan-out later the middle of the picture is lit. What comes before the first begin() is passed over, so
// a session in simulated time, which never begins, has no times and stays the same each time.
// Thread: the frame's. What is kept of every frame grows with the session; nothing else does.
#pragma once

#include <array>
#include <bitset>
#include <optional>
#include <string>
#include <vector>

#include "app/session/frame_times.hpp"
#include "haptics/histogram.hpp"

namespace burin {

enum class FrameStage : std::uint8_t {
    wait,    // asleep, until the next frame is due or something happens
    input,   // what happened is taken
    step,    // the session follows it; the carving side's news are taken
    record,  // what has changed is brought to the graphics device and its commands are written
    draw,    // the device, or the software driver, works, and is waited for
    show,    // the window's image is acquired, filled and handed to the display
};
inline constexpr std::size_t kFrameStages = 6;
[[nodiscard]] std::string_view name_of(FrameStage stage);

// How the display refreshes.
struct DisplayBeat {
    Nanoseconds period_ns = 16'666'667;
    std::optional<Nanoseconds> vblank_ns;  // the time of any one; nothing where none is seen
    Nanoseconds right_eye_later_ns = 0;    // as LatencySettings
};
// When a display begins to show what it was handed: at the next vblank, or half a period later, which is the mean, where they are unknown.
[[nodiscard]] Nanoseconds begins_to_show_ns(Nanoseconds handed_ns, const DisplayBeat& beat);

struct TimedFrame {
    FrameTimes times;
    FrameAges ages;
    std::array<Nanoseconds, kFrameStages> stage_ns{};
    Nanoseconds processor_ns = 0;  // of all threads, from begin() to finished()
};

// Of all threads of this process.
[[nodiscard]] Nanoseconds process_cpu_ns() noexcept;

class SessionTimes {
public:
    using Processor = Nanoseconds (*)() noexcept;
    // The clock must outlive it.
    explicit SessionTimes(Clock& clock, Processor processor = process_cpu_ns) : clock_(clock), processor_(processor) {}

    // ---- Told by the loop.
    void begin();
    void reached(FrameStage stage);
    void finished(bool drawn, const DisplayBeat& beat);
    // ---- Told by the session, of the frame that is made.
    void sampled(Nanoseconds head_ns, Nanoseconds tool_ns);  // 0: no such sample
    void cut(Nanoseconds cut_ns);                            // the newest on the surface that is drawn; 0: none

    // ---- What came of it.
    [[nodiscard]] bool running() const { return begun_; }
    [[nodiscard]] const FrameHistory& history() const { return history_; }
    [[nodiscard]] std::uint64_t drawn() const { return drawn_; }
    [[nodiscard]] std::uint64_t skipped() const { return skipped_; }
    [[nodiscard]] Nanoseconds period_ns() const { return beat_.period_ns; }
    // As they were at most kJudged_ns ago.
    static constexpr Nanoseconds kJudged_ns = 500'000'000;
    [[nodiscard]] const std::vector<FrameWarning>& warnings() const { return warnings_; }
    // Those that have come up since the last call; each once a session.
    [[nodiscard]] std::vector<std::string> take_new_warnings();

    // Every frame that was drawn, from now on.
    void keep_frames() { keeps_ = true; }
    [[nodiscard]] const std::vector<TimedFrame>& frames() const { return frames_; }

private:
    void judge(Nanoseconds now_ns);

    Clock& clock_;
    Processor processor_;
    FrameHistory history_;
    DisplayBeat beat_;
    TimedFrame frame_;  // the one that is made
    bool begun_ = false, keeps_ = false;
    Nanoseconds last_ns_ = 0, processor_at_begin_ns_ = 0;
    Nanoseconds cut_drawn_ns_ = 0;  // frames before have shown it
    std::uint64_t drawn_ = 0, skipped_ = 0;
    bool skipped_before_ = false;  // the frame before this one
    Nanoseconds judged_ns_ = 0;
    std::vector<FrameWarning> warnings_;
    std::bitset<64> said_;
    std::vector<std::string> new_warnings_;
    std::vector<TimedFrame> frames_;
};

// Of a histogram's counts: to within an eighth, but for the largest.
[[nodiscard]] FigureSummary summarised(const Histogram& histogram);

// What was added to a histogram between two looks, for one who comes by now and then.
class HistogramLook {
public:
    struct Seen {
        std::uint64_t count = 0;
        Nanoseconds longest_ns = 0;  // to within an eighth
    };
    [[nodiscard]] Seen look(const Histogram& histogram);

private:
    std::array<std::uint64_t, Histogram::kBuckets> before_{};
};

// What a whole session in real time took.
struct SessionRecord {
    std::vector<TimedFrame> frames;  // drawn
    std::uint64_t skipped = 0;       // looked at, and nothing had changed
    Nanoseconds wall_ns = 0, processor_ns = 0;
    Nanoseconds rested_ns = 0, rested_processor_ns = 0;  // of these when nothing had been drawn for 3 s
    FigureSummary carve_update;                          // on the carving thread, of those that changed the surface
    std::uint64_t ticks = 0, late_ticks = 0, missed_deadlines = 0;
    FigureSummary tick_lateness, tick_duration;
    std::vector<std::string> warnings;  // of the last frames
    std::string device;
};

}  // namespace burin
