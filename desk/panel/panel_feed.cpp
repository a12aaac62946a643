// SPDX-License-Identifier: MIT
#include "desk/panel/panel_feed.hpp"

#include "session/state/command_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin::session {
namespace {

// Appends a value. A plot has full length from the start, so that a constant value stands still at once.
void go_on(PanelPlot& plot, double value) {
    plot.values.resize(PanelFeed::kPlotLength, 0.0f);
    plot.values.erase(plot.values.begin());
    plot.values.push_back(static_cast<float>(value));
}

std::optional<double> median_ms(const FrameHistory& history, FrameFigure figure, std::size_t frames) {
    const FigureSummary summary = history.recent(figure, frames);
    if (summary.count == 0) return std::nullopt;
    return 1e3 * seconds(summary.median_ns);
}

PanelSavings savings_of(const renderer::RenderStats& drawn, const PanelFacts& facts) {
    const renderer::PatchCounts& counts = drawn.patch_counts;
    const double whole = static_cast<double>(facts.eye.width) * facts.eye.height;
    double redrawn = 0.0;
    for (const PixelRect& part : drawn.parts) redrawn += static_cast<double>(part.width) * part.height;
    return {drawn.patches,
            counts.drawn,
            counts.beside,
            counts.turned_away,
            counts.behind,
            counts.coarser,
            whole > 0.0 ? 100.0 * redrawn / whole : 0.0,
            facts.times.skipped()};
}

}  // namespace

ToolSizeRange tool_sizes_for(double longest_side_m) {
    const QuantityDescriptor& radius = descriptor_of(Quantity::radius);
    const double to_m = std::clamp(longest_side_m / 4.0, 100.0 * radius.least, 0.5 * radius.most);
    return {std::max(to_m / 100.0, radius.least), to_m};
}

void PanelFeed::feed(const PanelFacts& facts) {
    measured_ = {};
    if (facts.stirring) stirred_ns_ = facts.time_ns;
    const bool was_awake = awake_;
    awake_ = facts.time_ns - stirred_ns_ < kRest_ns;
    longest_force_N_ = std::max(longest_force_N_, facts.force_N);
    if (!facts.drawn.parts.empty()) drawn_ = facts.drawn;
    if (awake_ && facts.time_ns >= plotted_ns_ + kPlotStep_ns) {
        plotted_ns_ = facts.time_ns;
        go_on(force_N_, std::exchange(longest_force_N_, 0.0));
        if (facts.times.running()) measured_.plotted = plotted_times(facts);
        if (facts.recorded != nullptr) measured_.plotted = facts.recorded->plotted;
        if (measured_.plotted) plot(*measured_.plotted);
    }
    if ((awake_ && facts.time_ns >= renewed_ns_ + kNumberStep_ns) || (was_awake && !awake_)) renew_numbers(facts);
}

PanelPlotted PanelFeed::plotted_times(const PanelFacts& facts) {
    PanelPlotted plotted;
    plotted.tick_us = 1e6 * seconds(ticks_.look(facts.tick_duration).longest_ns);
    longest_tick_us_ = std::max(longest_tick_us_, plotted.tick_us);
    const std::uint64_t frames = facts.times.drawn() - std::exchange(plotted_frames_, facts.times.drawn());
    const FigureSummary summary = facts.times.history().recent(FrameFigure::frame_time, frames);
    // Without a frame, or without one that followed another, the display still shows the last one.
    const float before = frame_ms_.values.empty() ? 0.0f : frame_ms_.values.back();
    plotted.frame_ms = summary.count > 0 ? 1e3 * seconds(summary.most_ns) : double{before};
    plotted.frame_limit_ms = 1e3 * seconds(facts.times.period_ns());
    return plotted;
}

void PanelFeed::plot(const PanelPlotted& plotted) {
    go_on(tick_us_, plotted.tick_us);
    tick_us_.limit = 1000.0f;
    go_on(frame_ms_, plotted.frame_ms);
    frame_ms_.limit = static_cast<float>(plotted.frame_limit_ms);
}

void PanelFeed::renew_numbers(const PanelFacts& facts) {
    const double since_s = seconds(facts.time_ns - std::exchange(renewed_ns_, facts.time_ns));
    force_now_N_ = facts.force_N;
    energy_percent_ = static_cast<int>(std::lround(100.0 * (1.0 - std::clamp(facts.energy_share, 0.0, 1.0))));
    late_ticks_ = facts.late_ticks;
    dropped_samples_ = facts.dropped_samples;
    if (facts.times.running()) measured_.numbers = new_numbers(facts, since_s);
    measured_.acknowledged = facts.acknowledged;
    if (facts.recorded != nullptr) {
        measured_.numbers = facts.recorded->numbers;
        measured_.acknowledged = facts.recorded->acknowledged;
    }
    if (measured_.numbers) numbers_ = measured_.numbers;
    if (measured_.acknowledged) acknowledged_ = measured_.acknowledged;
    recording_ended_ = facts.recording_ended;
}

PanelNumbers PanelFeed::new_numbers(const PanelFacts& facts, double since_s) {
    PanelNumbers numbers;
    if (numbers_) numbers.figures = numbers_->figures;  // unknown figures keep their value
    PanelFigures& figures = numbers.figures;
    const std::uint64_t frames = facts.times.drawn() - std::exchange(renewed_frames_, facts.times.drawn());
    const FrameHistory& history = facts.times.history();
    const double tick_us = std::exchange(longest_tick_us_, 0.0);
    numbers.savings = savings_of(drawn_, facts);
    for (const FrameWarning& warning : facts.times.warnings()) numbers.warnings.push_back(warning.title);
    figures.frames_per_s = awake_ ? static_cast<double>(frames) / since_s : 0.0;
    if (!awake_) return numbers;
    if (tick_us > 0.0) figures.tick_us = tick_us;
    if (frames == 0) return numbers;
    figures.head_age_ms = median_ms(history, FrameFigure::head_age, frames);
    figures.motion_to_photon_ms = median_ms(history, FrameFigure::motion_to_photon, frames);
    figures.touch_before_sight_ms = median_ms(history, FrameFigure::touch_before_sight, frames);
    figures.draw_ms = median_ms(history, FrameFigure::draw_time, frames);
    if (const auto cut = median_ms(history, FrameFigure::carve_age, frames)) figures.carve_age_ms = cut;
    if (const auto frame = median_ms(history, FrameFigure::frame_time, frames)) figures.frame_ms = frame;
    return numbers;
}

void PanelFeed::show_on(PanelModel& model) const {
    model.force_N = force_N_;
    model.tick_us = tick_us_;
    model.frame_ms = frame_ms_;
    model.touch.force_N = force_now_N_;
    if (model.object) model.object->energy_percent = energy_percent_;
    model.touch.late_ticks = late_ticks_;
    model.touch.dropped_samples = dropped_samples_;
    if (acknowledged_) {
        const std::string upto = "on the disk up to tick " + std::to_string(*acknowledged_);
        model.sources.push_back({"Recording", recording_ended_ ? "has ended, " + upto : upto,
                                 recording_ended_ ? Condition::fault : Condition::good});
    }
    if (!numbers_) return;
    model.figures = numbers_->figures;
    model.savings = numbers_->savings;
    model.warnings.insert(model.warnings.end(), numbers_->warnings.begin(), numbers_->warnings.end());
}

}  // namespace burin::session
