// SPDX-License-Identifier: MIT
// Measures what the frames of a live session take and how old what they show is. The loop that makes the frames reports
// to it:
//
//   begin()  wait -> reached(wait)  input -> reached(input)  step -> reached(step), sampled(), cut()
//            for all screens: reached(record)  reached(show)  reached(draw)      finished(drawn, beat)
//
// A stage lasts from the previous reached() to its own. When a frame is seen is an estimate: the display shows it from
// the next refresh on, and half a scan-out later the middle of the picture is lit. Reports before the first begin() are
// ignored, so a session in simulated time, which never begins, has no times and stays
// the same each time.
// Thread: the frame's. Only the list of kept frames grows with the session.
#pragma once

#include <array>
#include <bitset>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compute/engine/engine.hpp"
#include "desk/timing/frame_times.hpp"
#include "haptics/histogram.hpp"

namespace burin::session {

enum class FrameStage : std::uint8_t {
    wait,    // asleep, until the next frame is due or something happens
    input,   // reading what happened
    step,    // session step; takes the carving side's surface updates
    record,  // uploading changes and recording commands
    show,    // acquiring and presenting the windows' images, while the device works
    draw,    // waiting until the device, or the software driver, has drawn them
};
inline constexpr std::size_t kFrameStages = 6;
[[nodiscard]] std::string_view name_of(FrameStage stage);

// Timing of the display's refresh.
struct DisplayBeat {
    Nanoseconds period_ns = 16'666'667;
    std::optional<Nanoseconds> vblank_ns;  // time of any one; none where none is seen
    Nanoseconds right_eye_later_ns = 0;    // see LatencySettings
};
// Returns when a display begins to show a presented picture: at the next vblank, or half a period later, the mean,
// where vblanks are unknown.
[[nodiscard]] Nanoseconds begins_to_show_ns(Nanoseconds handed_ns, const DisplayBeat& beat);

// What a frame shows that the one before did not: for people, what they were doing.
struct FrameMotion {
    bool view = false, tool = false;  // all of the picture has changed; the tool has moved
    bool works = false;               // its button is down, or what it cut is shown
};

struct TimedFrame {
    FrameTimes times;
    FrameMotion motion;
    FrameAges ages;
    std::array<Nanoseconds, kFrameStages> stage_ns{};
    Nanoseconds processor_ns = 0;  // of all threads, from begin() to finished()
    // From a press of the button until this frame is seen, which is the first to show a cut of it.
    std::optional<Nanoseconds> click_ns;
};

// Returns the processor time of all threads of this process.
[[nodiscard]] Nanoseconds process_cpu_ns() noexcept;

class SessionTimes {
public:
    using Processor = Nanoseconds (*)() noexcept;
    // The clock must outlive it.
    explicit SessionTimes(Clock& clock, Processor processor = process_cpu_ns) : clock_(clock), processor_(processor) {}

    // ---- Reported by the loop.
    void begin();
    void reached(FrameStage stage);
    void finished(bool drawn, const DisplayBeat& beat);
    // ---- Reported by the session, about the frame in progress.
    void sampled(Nanoseconds head_ns, Nanoseconds tool_ns);  // 0: no such sample
    void cut(Nanoseconds cut_ns);                            // newest cut on the surface drawn; 0: none
    void moved(const FrameMotion& motion);                   // besides what cut() and works() tell
    void works() { frame_.motion.works = true; }
    void pressed(Nanoseconds pressed_ns) { pressed_ns_ = pressed_ns; }  // a button that may begin a cut

    // ---- Results.
    [[nodiscard]] bool running() const { return begun_; }
    [[nodiscard]] const FrameHistory& history() const { return history_; }
    [[nodiscard]] std::uint64_t drawn() const { return drawn_; }
    [[nodiscard]] std::uint64_t skipped() const { return skipped_; }
    [[nodiscard]] Nanoseconds period_ns() const { return beat_.period_ns; }
    // Returns warnings as of at most kJudged_ns ago.
    static constexpr Nanoseconds kJudged_ns = 500'000'000;
    [[nodiscard]] const std::vector<FrameWarning>& warnings() const { return warnings_; }
    // Returns warnings that have come up since the last call; each once a session.
    [[nodiscard]] std::vector<std::string> take_new_warnings();

    // Keeps every frame that is drawn from now on.
    void keep_frames() { keeps_ = true; }
    [[nodiscard]] const std::vector<TimedFrame>& frames() const { return frames_; }

private:
    void judge(Nanoseconds now_ns);

    Clock& clock_;
    Processor processor_;
    FrameHistory history_;
    DisplayBeat beat_;
    TimedFrame frame_;  // the frame in progress
    bool begun_ = false, keeps_ = false;
    Nanoseconds last_ns_ = 0, processor_at_begin_ns_ = 0;
    std::optional<Nanoseconds> pressed_ns_;  // no cut of it has been shown yet
    Nanoseconds cut_drawn_ns_ = 0;           // newest cut that earlier frames have shown
    std::uint64_t drawn_ = 0, skipped_ = 0;
    bool skipped_before_ = false;  // whether the previous frame was skipped
    Nanoseconds judged_ns_ = 0;
    std::vector<FrameWarning> warnings_;
    std::bitset<64> warned_;  // by limit
    std::vector<std::string> new_warnings_;
    std::vector<TimedFrame> frames_;
};

// Summarises a histogram's counts: to within an eighth, except for the largest.
[[nodiscard]] FigureSummary summarised(const haptics::Histogram& histogram);

// Reads what was added to a histogram since the previous look.
class HistogramLook {
public:
    struct Seen {
        std::uint64_t count = 0;
        Nanoseconds longest_ns = 0;  // to within an eighth
    };
    [[nodiscard]] Seen look(const haptics::Histogram& histogram);

private:
    std::array<std::uint64_t, haptics::Histogram::kBuckets> before_{};
};

// Times of a whole session in real time.
struct SessionRecord {
    std::vector<TimedFrame> frames;  // drawn
    std::uint64_t skipped = 0;       // turns in which nothing had changed
    Nanoseconds wall_ns = 0, processor_ns = 0;
    // Parts of these after 3 s without a drawn frame.
    Nanoseconds rested_ns = 0, rested_processor_ns = 0;
    // On the carving thread, of updates that changed the surface.
    FigureSummary carve_update;
    std::string engine;  // that carved at the end; empty where nothing was carved
    std::optional<compute::DeviceTraffic> engine_traffic;
    std::uint64_t updates = 0, rays_changed = 0;            // of the workpiece
    std::optional<compute::DeviceTraffic> picture_traffic;  // of the lane that draws, since its device was opened
    double machine_pace = 1.0;                              // that bounded a tick's work (haptics::WorkSettings)
    std::uint64_t ticks = 0, late_ticks = 0, missed_deadlines = 0;
    std::uint64_t lost_targets = 0;  // of the steered hand
    FigureSummary tick_lateness, tick_duration;
    std::vector<std::string> warnings;  // of the last frames
    std::string device;
};

}  // namespace burin::session
