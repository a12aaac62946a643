// SPDX-License-Identifier: MIT
// Writes the comparison of workspace techniques as table, CSV, JSON and figure.
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "base/plot/figures.hpp"
#include "base/statistics.hpp"
#include "base/text.hpp"
#include "bench/workspace/workspace.hpp"

namespace burin::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Statistics of the targets that were reached; NaN where none was.
struct Summary {
    std::string name;
    std::size_t reached = 0, failures = 0;
    double time_s_median = kNone, time_s_p90 = kNone, hand_path_m_median = kNone, tool_path_m_median = kNone,
           presses_median = kNone, presses_p90 = kNone, overshoot_mm_median = kNone, overshoot_mm_p90 = kNone,
           precision_mm_rms = kNone;
};

std::vector<double> each(const std::vector<Reach>& reaches, const std::function<double(const Reach&)>& value) {
    std::vector<double> values;
    for (const Reach& r : reaches) {
        if (r.reached) values.push_back(value(r));
    }
    return values;
}

Summary summary_of(const WorkspaceFigures& figures) {
    Summary s;
    s.name = figures.approach.name;
    const auto of = [&](const std::function<double(const Reach&)>& value, double share) {
        const std::vector<double> values = each(figures.reaches, value);
        return values.empty() ? kNone : quantile(values, share);
    };
    const auto squares = each(figures.reaches, [](const Reach& r) { return r.precision_m * r.precision_m; });
    s.reached = squares.size();
    s.failures = figures.reaches.size() - s.reached;
    const auto time = [](const Reach& r) { return r.time_s; };
    const auto presses = [](const Reach& r) { return 1.0 * r.presses; };
    const auto overshoot = [](const Reach& r) { return 1e3 * r.overshoot_m; };
    s.time_s_median = of(time, 0.5);
    s.time_s_p90 = of(time, 0.9);
    s.hand_path_m_median = of([](const Reach& r) { return r.hand_path_m; }, 0.5);
    s.tool_path_m_median = of([](const Reach& r) { return r.tool_path_m; }, 0.5);
    s.presses_median = of(presses, 0.5);
    s.presses_p90 = of(presses, 0.9);
    s.overshoot_mm_median = of(overshoot, 0.5);
    s.overshoot_mm_p90 = of(overshoot, 0.9);
    if (s.reached > 0) s.precision_mm_rms = 1e3 * std::sqrt(sum(squares) / static_cast<double>(s.reached));
    return s;
}

struct Column {
    const char* name;
    double Summary::* value;
    int digits;
};

constexpr std::array<Column, 9> kColumns{{{"time_median_s", &Summary::time_s_median, 2},
                                          {"time_p90_s", &Summary::time_s_p90, 2},
                                          {"hand_path_median_m", &Summary::hand_path_m_median, 3},
                                          {"tool_path_median_m", &Summary::tool_path_m_median, 3},
                                          {"presses_median", &Summary::presses_median, 0},
                                          {"presses_p90", &Summary::presses_p90, 0},
                                          {"overshoot_median_mm", &Summary::overshoot_mm_median, 1},
                                          {"overshoot_p90_mm", &Summary::overshoot_mm_p90, 1},
                                          {"precision_rms_mm", &Summary::precision_mm_rms, 2}}};

// Returns null for NaN, which JSON does not have.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string cell(double value, int digits) { return std::isfinite(value) ? formatted("%.*f", digits, value) : ""; }

std::vector<std::string> assumption_lines(const WorkspaceTask& t) {
    return {
        "A simulated hand, not people: it knows each technique, never tires and never learns.",
        formatted(
            "Targets of %.0f mm radius on a wall of %.2f x %.2f m, within %.0f mm of its plane; to be kept for %.1f s.",
            1e3 * t.target_radius_m, t.wall_m.x, t.wall_m.y, 500.0 * t.wall_m.z, t.dwell_s),
        formatted(
            "Minimum-jerk submovements of %.2f s + %.2f s log2(1 + D / 2 mm), off at their ends by %.0f ms x mean "
            "speed and at least %.1f mm (assumed).",
            t.hand.shortest_s, t.hand.per_bit_s, 1e3 * t.hand.spread_s, 1e3 * t.hand.least_spread_m),
        formatted(
            "It sees %.0f ms late, a press takes %.1f s, tremor is %.2f mm rms an axis, the grip yields %.0f mm a "
            "newton.",
            1e3 * t.vision_s, 2.0 * t.finger_s, 1e3 * t.hand.tremor_m, 1e3 / t.hand.grip_N_per_m),
        "The device is a simulated Omni: 162.6 x 121.9 x 71.1 mm, encoder steps of 0.055 mm, 3.3 N."};
}

}  // namespace

std::string assumptions(const WorkspaceTask& task) {
    std::string text;
    for (const std::string& line : assumption_lines(task)) text += line + "\n";
    return text;
}

std::string workspace_table(const std::vector<WorkspaceFigures>& figures) {
    std::string text =
        "technique       reached  time_s        path_m         presses      overshoot_mm    precision\n"
        "                         median   p90   hand    tool  median  p90  median    p90      rms_mm\n";
    for (const WorkspaceFigures& f : figures) {
        const Summary s = summary_of(f);
        const auto wide = [](double value, int digits, int width) {
            const std::string number = cell(value, digits);
            return formatted("%*s", width, number.empty() ? "-" : number.c_str());
        };
        text += formatted("%-14s %4zu/%-4zu", s.name.c_str(), s.reached, f.reaches.size());
        text += wide(s.time_s_median, 2, 7) + wide(s.time_s_p90, 2, 7) + wide(s.hand_path_m_median, 2, 7) +
                wide(s.tool_path_m_median, 2, 8) + wide(s.presses_median, 0, 8) + wide(s.presses_p90, 0, 5) +
                wide(s.overshoot_mm_median, 1, 8) + wide(s.overshoot_mm_p90, 1, 7) + wide(s.precision_mm_rms, 2, 12) +
                "\n";
    }
    return text;
}

std::string workspace_csv(const std::vector<WorkspaceFigures>& figures) {
    std::string text = "technique,targets,reached,failures";
    for (const Column& column : kColumns) text += std::string(",") + column.name;
    text += "\n";
    for (const WorkspaceFigures& f : figures) {
        const Summary s = summary_of(f);
        text += "\"" + s.name + "\"" + formatted(",%zu,%zu,%zu", f.reaches.size(), s.reached, s.failures);
        for (const Column& column : kColumns) text += "," + cell(s.*column.value, column.digits + 2);
        text += "\n";
    }
    return text;
}

Json workspace_json(const std::vector<WorkspaceFigures>& figures, const WorkspaceTask& task) {
    Json report;
    report["task"] = {{"targets", task.targets},
                      {"seed", task.seed},
                      {"wall_width_m", task.wall_m.x},
                      {"wall_height_m", task.wall_m.y},
                      {"target_radius_m", task.target_radius_m},
                      {"dwell_s", task.dwell_s},
                      {"hold_s", task.hold_s},
                      {"give_up_s", task.give_up_s},
                      {"vision_delay_s", task.vision_s},
                      {"press_s", 2.0 * task.finger_s}};
    report["assumptions"] = assumption_lines(task);
    report["techniques"] = Json::array();
    for (const WorkspaceFigures& f : figures) {
        const Summary s = summary_of(f);
        Json row = {{"technique", s.name},
                    {"settings_technique", text(f.approach.technique)},
                    {"reached", s.reached},
                    {"failures", s.failures}};
        for (const Column& column : kColumns) row[column.name] = number(s.*column.value);
        row["targets"] = Json::array();
        for (const Reach& r : f.reaches) {
            row["targets"].push_back({{"reached", r.reached},
                                      {"distance_m", r.distance_m},
                                      {"time_s", r.time_s},
                                      {"hand_path_m", r.hand_path_m},
                                      {"tool_path_m", r.tool_path_m},
                                      {"presses", r.presses},
                                      {"overshoot_m", r.overshoot_m},
                                      {"precision_m", r.reached ? Json(r.precision_m) : Json(nullptr)}});
        }
        report["techniques"].push_back(row);
    }
    return report;
}

std::string workspace_svg(const std::vector<WorkspaceFigures>& figures, const WorkspaceTask& task) {
    std::vector<plot::DotPanel> panels{
        {"time to the target, s", true, 1, {}}, {"path of the hand, m", true, 2, {}},
        {"path of the tool, m", false, 2, {}},  {"presses", false, 0, {}},
        {"overshoot, mm", false, 1, {}},        {"precision of the hold, mm rms", false, 2, {}}};
    std::vector<std::string> names;
    for (const WorkspaceFigures& f : figures) {
        const Summary s = summary_of(f);
        names.push_back(s.name + formatted(" %zu/%zu", s.reached, f.reaches.size()));
        panels[0].values.push_back({s.time_s_median, s.time_s_p90});
        panels[1].values.push_back({s.hand_path_m_median, 0.0});
        panels[2].values.push_back({s.tool_path_m_median, 0.0});
        panels[3].values.push_back({s.presses_median, s.presses_p90});
        panels[4].values.push_back({s.overshoot_mm_median, s.overshoot_mm_p90});
        panels[5].values.push_back({s.precision_mm_rms, 0.0});
    }
    std::vector<std::string> notes{
        "Medians of the targets that were reached (how many stands beside the name); thin lines to the 90 % quantile."};
    for (const std::string& line : assumption_lines(task)) notes.push_back(line);
    return plot::dot_chart("Reaching across the wall with a small device", names, panels, notes);
}

}  // namespace burin::bench
