// SPDX-License-Identifier: MIT
// Feeds the panel with a session's measured times: plots that advance ten times a second, and numbers that change twice
// a second, so that one can read them. While the session rests both stand still: a moving panel would be all there is
// to draw.
// Force is known in simulated time as well; ticks and frames take no time there, and nothing is shown of them. A
// session that replays a recording shows what was measured then.
// One thread, the frame's.
#pragma once

#include "desk/panel/panel_model.hpp"
#include "desk/timing/session_times.hpp"
#include "renderer/frame/renderer.hpp"
#include "session/record/panel_measured.hpp"

namespace burin::session {

// Inputs of one step.
struct PanelFacts {
    Nanoseconds time_ns = 0;  // session time
    double force_N = 0.0;
    std::uint64_t late_ticks = 0, dropped_samples = 0;
    bool stirring = false;  // something other than the panel is active
    const SessionTimes& times;
    const haptics::Histogram& tick_duration;
    const renderer::RenderStats& drawn;  // of the previous frame
    ImageSize eye;
    // The last tick of the session file that is on the disk; none: no such file is recorded. Whether its recording has
    // ended before the session.
    std::optional<std::uint64_t> acknowledged = std::nullopt;
    bool recording_ended = false;
    // Recorded times to show; null: the session's own.
    const PanelMeasured* recorded = nullptr;
    double energy_share = 1.0;  // ToolState::energy_share
};

class PanelFeed {
public:
    static constexpr Nanoseconds kPlotStep_ns = 100'000'000, kNumberStep_ns = 500'000'000;
    static constexpr Nanoseconds kRest_ns = 1'000'000'000;  // after the last activity
    static constexpr std::size_t kPlotLength = 100;         // ten seconds

    void feed(const PanelFacts& facts);
    void show_on(PanelModel& model) const;
    // Returns what was new in the last step, for the recorder.
    [[nodiscard]] const PanelMeasured& measured() const { return measured_; }

private:
    [[nodiscard]] PanelPlotted plotted_times(const PanelFacts& facts);
    void plot(const PanelPlotted& plotted);
    void renew_numbers(const PanelFacts& facts);
    [[nodiscard]] PanelNumbers new_numbers(const PanelFacts& facts, double since_s);

    Nanoseconds plotted_ns_ = -kPlotStep_ns, renewed_ns_ = -kNumberStep_ns, stirred_ns_ = 0;
    bool awake_ = false;
    PanelPlot force_N_, tick_us_, frame_ms_;
    HistogramLook ticks_;
    std::uint64_t plotted_frames_ = 0, renewed_frames_ = 0;  // frames drawn by then
    // Maxima since the numbers changed and since the plots advanced.
    double longest_tick_us_ = 0.0, longest_force_N_ = 0.0;
    double force_now_N_ = 0.0;
    int energy_percent_ = 0;
    std::uint64_t late_ticks_ = 0, dropped_samples_ = 0;
    renderer::RenderStats drawn_;  // of the last frame that drew anything
    std::optional<PanelNumbers> numbers_;
    std::optional<std::uint64_t> acknowledged_;
    bool recording_ended_ = false;
    PanelMeasured measured_;
};

}  // namespace burin::session
