// SPDX-License-Identifier: MIT
// What the panel shows of a session's times: plots that go on ten times a second, and numbers that change twice a second, so that one
// can read them. While the session rests both stand still: a panel that moves would be all there is to draw.
// Force is known in simulated time as well; ticks and frames take none there, and nothing is shown of them. A session that follows a
// recording shows what was measured then.
// One thread, the frame's.
#pragma once

#include "app/session/panel_model.hpp"
#include "app/session/session_times.hpp"
#include "renderer/renderer.hpp"

namespace burin {

// What clocks said, of one step of the session: new points of plots, new numbers, where it is time for them.
struct PanelPlotted {
    double tick_us = 0.0, frame_ms = 0.0;  // the longest since the points before
    double frame_limit_ms = 0.0;
};
struct PanelNumbers {
    PanelFigures figures;
    PanelSavings savings;
    std::vector<std::string> warnings;
};
struct PanelMeasured {
    std::optional<PanelPlotted> plotted;
    std::optional<PanelNumbers> numbers;
};

// Of one step of the session.
struct PanelFacts {
    Nanoseconds time_ns = 0;  // the session's
    double force_N = 0.0;
    std::uint64_t late_ticks = 0, dropped_samples = 0;
    bool stirring = false;  // something happens besides the panel
    const SessionTimes& times;
    const Histogram& tick_duration;
    const RenderStats& drawn;  // of the frame before
    ImageSize eye;
    const PanelMeasured* recorded = nullptr;  // what to show in place of times; null: the session's own
};

class PanelFeed {
public:
    static constexpr Nanoseconds kPlotStep_ns = 100'000'000, kNumberStep_ns = 500'000'000;
    static constexpr Nanoseconds kRest_ns = 1'000'000'000;  // after the last stir
    static constexpr std::size_t kPlotLength = 100;         // ten seconds

    void feed(const PanelFacts& facts);
    void show_on(PanelModel& model) const;
    // What was new in the last step, for who records it.
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
    std::uint64_t plotted_frames_ = 0, renewed_frames_ = 0;  // drawn until then
    double longest_tick_us_ = 0.0, longest_force_N_ = 0.0;   // since the numbers changed; since the plots did
    double force_now_N_ = 0.0;
    std::uint64_t late_ticks_ = 0, dropped_samples_ = 0;
    RenderStats drawn_;  // of the last frame in which anything was
    std::optional<PanelNumbers> numbers_;
    PanelMeasured measured_;
};

}  // namespace burin
