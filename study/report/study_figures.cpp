// SPDX-License-Identifier: MIT
#include "study/report/study_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/plot/figures.hpp"
#include "base/plot/svg.hpp"
#include "base/statistics.hpp"

namespace burin::study {
namespace {

constexpr double kBoxWidth = 300.0, kAside = 40.0, kBoxHeight = 46.0, kBoxGap = 24.0, kFlowTop = 44.0;
constexpr double kRowHeight = 30.0, kNames = 200.0, kAxisWidth = 230.0, kNumbers = 150.0, kIntervalTop = 46.0;

std::string box(double middle, double top, const std::string& first, const std::string& second,
                double width = kBoxWidth) {
    return plot::rectangle(middle - 0.5 * width, top, width, kBoxHeight, "#f6f6f6", "#333333") +
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

// The trials of one stage and world.
struct LearningPanel {
    std::string title, stage, world;
    std::vector<const Trial*> trials;
    std::map<std::string, std::set<int>> lost;  // by participant, the numbers
};

std::vector<LearningPanel> panels_of(const TrialTable& table) {
    std::vector<LearningPanel> panels;
    const auto panel_of = [&](const auto& trial) {
        return std::ranges::find_if(
            panels, [&](const LearningPanel& p) { return p.stage == trial.stage && p.world == trial.world; });
    };
    for (const Trial& trial : table.trials) {
        if (panel_of(trial) == panels.end())
            panels.push_back({trial.stage + (trial.world.empty() ? "" : ", world " + trial.world),
                              trial.stage,
                              trial.world,
                              {},
                              {}});
        panel_of(trial)->trials.push_back(&trial);
    }
    for (const LostTrial& lost : table.lost)
        if (const auto panel = panel_of(lost); panel != panels.end()) panel->lost[lost.participant].insert(lost.number);
    return panels;
}

// A line for each participant of a group; it ends where another day begins or a trial was lost.
void add_people(plot::Plot& plot, const LearningPanel& panel, const std::string& group, double Trial::* values) {
    std::map<std::string, std::vector<const Trial*>> people;
    for (const Trial* trial : panel.trials)
        if (trial->group == group) people[trial->participant].push_back(trial);
    for (auto& [person, trials] : people) {
        std::ranges::stable_sort(trials, {}, &Trial::number);
        const auto lost = panel.lost.find(person);
        const auto is_between = [&](const Trial* before, const Trial* after) {
            if (lost == panel.lost.end()) return false;
            const auto next = lost->second.upper_bound(before->number);
            return next != lost->second.end() && *next < after->number;
        };
        for (std::size_t i = 0; i < trials.size(); ++i) {
            if (i == 0 || trials[i]->day != trials[i - 1]->day || is_between(trials[i - 1], trials[i]))
                plot.series.push_back({group, {}, 0.7, {}});
            plot.series.back().points.push_back({static_cast<double>(trials[i]->number), trials[i]->*values, ""});
        }
    }
}

// A line for each day.
void add_median(plot::Plot& plot, const LearningPanel& panel, const std::string& group, double Trial::* values) {
    std::map<std::string, std::map<int, std::vector<double>>> by_day;
    for (const Trial* trial : panel.trials)
        if (trial->group == group) by_day[trial->day][trial->number].push_back(trial->*values);
    for (const auto& [day, trials] : by_day) {
        plot::PlotSeries middle{group + ", median", {}, 3.0, group};
        for (const auto& [number, all] : trials)
            middle.points.push_back({static_cast<double>(number), middle_of_known(all), ""});
        plot.series.push_back(std::move(middle));
    }
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
        // Who is not analysed stands beside the way of those who are.
        const double way = middle - 0.5 * kBoxWidth + 0.5 * kAside, aside = kFlowTop + 2.0 * step + 0.5 * kBoxHeight;
        text += arrow(way, kFlowTop + step + kBoxHeight, way, kFlowTop + 3.0 * step);
        text += plot::line(way, aside, way + 0.5 * kAside, aside, "#333333");
        text += box(middle + 0.5 * kAside, kFlowTop + 2.0 * step, formatted("%zu not analysed", g.not_analysed()),
                    formatted("%zu withdrew, %zu not finished, %zu no valid trial", g.withdrew, g.unfinished,
                              g.without_valid_trial),
                    kBoxWidth - kAside);
        text += box(middle, kFlowTop + 3.0 * step, formatted("%zu analysed", g.analysed()),
                    formatted("%zu with all outcome trials, %zu with some", g.with_all, g.with_some));
    }
    return text + "</svg>\n";
}

std::string learning_figure(const TrialTable& table, const std::string& measure, const std::string& unit,
                            double Trial::* values) {
    std::vector<LearningPanel> panels = panels_of(table);
    std::vector<plot::Plot> plots;
    double highest = 1e-9;
    for (const Trial& trial : table.trials) highest = std::max(highest, trial.*values);
    for (const LearningPanel& panel : panels) {
        plot::Plot plot{panel.title.empty() ? measure + " from trial to trial" : panel.title,
                        "trial of the protocol",
                        unit.empty() ? measure : measure + " (" + unit + ")",
                        {},
                        true,
                        true,
                        true};
        for (const std::string& group : table.groups) {
            add_people(plot, panel, group, values);
            add_median(plot, panel, group, values);
        }
        plot.x_whole = true;
        plot.y_lowest = 0.0;
        plot.y_highest = highest;
        plots.push_back(std::move(plot));
    }
    return plot::svg_figure("Learning: " + measure, plots, 2);
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
