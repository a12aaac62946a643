// SPDX-License-Identifier: MIT
#include "study/report/study_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/plot/figures.hpp"
#include "base/plot/svg.hpp"
#include "base/statistics.hpp"

namespace burin::study {
namespace {

constexpr double kBoxWidth = 190.0, kBoxHeight = 46.0, kBoxGap = 24.0, kFlowTop = 44.0;
constexpr double kRowHeight = 30.0, kNames = 200.0, kAxisWidth = 230.0, kNumbers = 150.0, kIntervalTop = 46.0;

std::string box(double middle, double top, const std::string& first, const std::string& second) {
    return plot::rectangle(middle - 0.5 * kBoxWidth, top, kBoxWidth, kBoxHeight, "#f6f6f6", "#333333") +
           plot::write(middle, top + 19.0, "text-anchor=\"middle\" font-size=\"12\"", first) +
           plot::write(middle, top + 36.0, "text-anchor=\"middle\"", second);
}

std::string arrow(double x0, double y0, double x1, double y1) {
    return plot::line(x0, y0, x1, y1, "#333333") +
           formatted("<path d=\"M%.1f %.1f l-4 -7 h8 z\" fill=\"#333333\"/>\n", x1, y1);
}

double middle_of_known(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    return values.empty() ? kUndefined : middle_value(std::move(values));
}

// The range that all values, their intervals and 0 lie in, with a margin.
struct Range {
    double lo = 0.0, hi = 0.0;

    void include(double value) {
        if (!std::isfinite(value)) return;
        lo = std::min(lo, value);
        hi = std::max(hi, value);
    }
    [[nodiscard]] double place(double value) const { return kNames + kAxisWidth * (value - lo) / (hi - lo); }
};

Range range_of(const std::vector<IntervalRow>& rows) {
    Range range;
    for (const IntervalRow& row : rows) {
        range.include(row.estimate.value);
        range.include(row.estimate.low);
        range.include(row.estimate.high);
    }
    if (!(range.hi > range.lo)) range.hi = range.lo + 1.0;
    const double margin = 0.06 * (range.hi - range.lo);
    return {range.lo - margin, range.hi + margin};
}

std::string interval_row(const IntervalRow& row, double y, const Range& range) {
    const Estimate& e = row.estimate;
    std::string text = plot::write(8.0, y + 4.0, "", row.name);
    if (std::isfinite(e.low) && std::isfinite(e.high)) {
        const double lo = range.place(e.low), hi = range.place(e.high);
        text += plot::line(lo, y, hi, y, "#000000", " stroke-width=\"1.6\"");
        for (const double end : {lo, hi}) text += plot::line(end, y - 5.0, end, y + 5.0, "#000000");
    }
    if (!std::isfinite(e.value)) return text + plot::write(kNames + kAxisWidth + 12.0, y + 4.0, "", "undefined");
    text += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"#000000\"/>\n", range.place(e.value), y);
    const std::string interval = std::isfinite(e.low) ? formatted(" (%.3g to %.3g)", e.low, e.high) : "";
    return text + plot::write(kNames + kAxisWidth + 12.0, y + 4.0, "", formatted("%.3g", e.value) + interval);
}

}  // namespace

std::string flow_figure(const std::vector<FlowOfGroup>& groups) {
    const double columns = static_cast<double>(std::max<std::size_t>(1, groups.size()));
    const double width = columns * (kBoxWidth + kBoxGap) + kBoxGap;
    const double step = kBoxHeight + 30.0, height = kFlowTop + 4.0 * step;
    std::string text = plot::svg_begin(width, height, "Flow of participants", 26.0);
    std::size_t enrolled = 0;
    for (const FlowOfGroup& g : groups) enrolled += g.allocated;
    text += box(0.5 * width, kFlowTop, formatted("%zu enrolled", enrolled), "all were allocated");
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const FlowOfGroup& g = groups[i];
        const double middle = kBoxGap + 0.5 * kBoxWidth + static_cast<double>(i) * (kBoxWidth + kBoxGap);
        text += arrow(0.5 * width, kFlowTop + kBoxHeight, middle, kFlowTop + step);
        text += box(middle, kFlowTop + step, formatted("%s: %zu", g.group.c_str(), g.allocated), "allocated");
        text += arrow(middle, kFlowTop + step + kBoxHeight, middle, kFlowTop + 2.0 * step);
        text += box(middle, kFlowTop + 2.0 * step, formatted("%zu withdrew", g.withdrew),
                    formatted("%zu unfinished, %zu no valid trial", g.unfinished, g.without_valid_trial));
        text += arrow(middle, kFlowTop + 2.0 * step + kBoxHeight, middle, kFlowTop + 3.0 * step);
        text +=
            box(middle, kFlowTop + 3.0 * step, formatted("%zu analysed", g.analysed), "with all their valid trials");
    }
    return text + "</svg>\n";
}

std::string learning_figure(const UnitAnalysis& trials, const std::string& measure, const std::string& unit,
                            std::vector<double> GroupSummary::* values) {
    plot::Plot plot{measure + " from trial to trial",
                    "trial",
                    unit.empty() ? measure : measure + " (" + unit + ")",
                    {},
                    true,
                    true,
                    true};
    for (const GroupSummary& group : trials.groups) {
        std::map<std::string, plot::PlotSeries> lines;
        std::map<int, std::vector<double>> by_trial;
        for (std::size_t i = 0; i < group.participants.size(); ++i) {
            const double value = (group.*values)[i];
            plot::PlotSeries& line = lines[group.participants[i]];
            line.name = group.group;
            line.width = 0.7;
            line.points.push_back({static_cast<double>(group.trial_numbers[i]), value, ""});
            by_trial[group.trial_numbers[i]].push_back(value);
        }
        for (auto& [person, line] : lines) plot.series.push_back(std::move(line));
        plot::PlotSeries middle{group.group + ", median", {}, 3.0};
        for (const auto& [trial, all] : by_trial)
            middle.points.push_back({static_cast<double>(trial), middle_of_known(all), ""});
        plot.series.push_back(std::move(middle));
    }
    plot.y_lowest = 0.0;
    plot.y_highest = 1e-9;
    return plot::svg_figure("Learning: " + measure, {plot}, 1);
}

std::string interval_figure(const std::string& title, const std::string& axis, const std::vector<IntervalRow>& rows) {
    const Range range = range_of(rows);
    const double bottom = kIntervalTop + kRowHeight * static_cast<double>(rows.size());
    const double width = kNames + kAxisWidth + kNumbers;
    std::string text = plot::svg_begin(width, bottom + 48.0, title, 26.0);
    const double step = plot::round_step((range.hi - range.lo) / 4.0);
    for (double i = std::ceil(range.lo / step); i * step <= range.hi; ++i) {
        const double x = range.place(i * step);
        text += plot::line_down(x, kIntervalTop, bottom - kIntervalTop, i == 0.0 ? "#555555" : "#dddddd");
        text += plot::write(x, bottom + 16.0, "text-anchor=\"middle\"", formatted("%g", i * step + 0.0));
    }
    text += plot::write(kNames + 0.5 * kAxisWidth, bottom + 36.0, "text-anchor=\"middle\"", axis);
    for (std::size_t i = 0; i < rows.size(); ++i)
        text += interval_row(rows[i], kIntervalTop + kRowHeight * (static_cast<double>(i) + 0.5), range);
    return text + "</svg>\n";
}

}  // namespace burin::study
