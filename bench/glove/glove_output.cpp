// SPDX-License-Identifier: MIT
#include "bench/glove/glove_output.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "base/plot/figures.hpp"
#include "base/text.hpp"

namespace burin::bench {
namespace {

constexpr std::array kSurfaceNames{"plate", "ball"}, kTurnNames{"roll", "pitch"};
constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string name_of(const PatchFigures& patch) {
    if (patch.points == 1) return "1 point";
    return formatted("%zu points, %g mm", patch.points, 1e3 * patch.extent_m);
}

bool is_default(const GloveFigures& figures, const PatchFigures& patch) {
    return patch.points == figures.default_points && std::abs(patch.extent_m - figures.default_extent_m) < 1e-6;
}

const char* place_of(MadeAt at) { return at == MadeAt::controller ? "controller" : "host"; }

// The layouts whose forces are drawn: one point, the paper's five at three extents, and twenty at the widest but one.
bool is_drawn(const PatchFigures& patch) {
    const auto near = [&](double extent_m) { return std::abs(patch.extent_m - extent_m) < 1e-6; };
    return patch.points == 1 || (patch.points == 5 && (near(0.003) || near(0.006))) ||
           (patch.points == 20 && near(0.009));
}

plot::Plot forces_plot(const PressFigures& press, std::size_t turn) {
    plot::Plot plot;
    plot.title = turn == 0 ? "Rolled about its bone, on a plate" : "Pitched across it, on a plate";
    plot.x_label = "angle (degrees)";
    plot.y_label = "force over its force when flat";
    plot.x_linear = plot.y_linear = true;
    plot.markers = false;
    const auto add = [&](const std::string& name, const std::vector<double>& forces, double width) {
        plot::PlotSeries series;
        series.name = name;
        series.width = width;
        for (std::size_t i = 0; i < forces.size(); ++i)
            series.points.push_back({kDegrees * press.angles_rad[i], forces[i], ""});
        plot.series.push_back(std::move(series));
    };
    add("the whole pad", press.pad_force[turn], 3.0);
    for (std::size_t i = 0; i < press.patches.size(); ++i)
        if (is_drawn(press.patches[i])) add(name_of(press.patches[i]), press.patch_forces[turn][i], 0.0);
    return plot;
}

plot::Plot departures_plot(const PressFigures& press, std::size_t turn) {
    plot::Plot plot;
    plot.title = turn == 0 ? "Departure from the pad, rolled" : "Departure from the pad, pitched";
    plot.x_label = "extent of the patch (mm)";
    plot.y_label = "rms, as a share of the pad's force";
    plot.x_linear = plot.y_linear = true;
    std::map<std::size_t, plot::PlotSeries> by_number;
    for (const PatchFigures& patch : press.patches) {
        if (patch.points == 1) continue;
        plot::PlotSeries& series = by_number[patch.points];
        series.name = formatted("%zu points", patch.points);
        series.points.push_back({1e3 * patch.extent_m, patch.departures[0][turn].rms, ""});
    }
    for (auto& [number, series] : by_number) plot.series.push_back(std::move(series));
    plot.y_lowest = 0.0;
    plot.y_highest = 1.0;
    return plot;
}

}  // namespace

std::string glove_table(const GloveFigures& figures) {
    const PressFigures& press = figures.press;
    std::string text = formatted(
        "An index fingertip, %g mm deep in a plate or a ball of %g mm, turned by %.0f degrees to either side. How far "
        "the\n"
        "force of a patch departs from that of the whole pad (%zu points within %g mm), each as stiff as the pad when "
        "flat,\n"
        "as a share of the pad's: rms (worst). Gain: what makes it as stiff as the pad when flat.\n\n",
        1e3 * figures.task.depth_m, 1e3 * figures.task.ball_m, kDegrees * figures.task.most_rad,
        figures.task.reference_points, 1e3 * press.pad_m);
    text += "patch                gain    plate: roll     plate: pitch     ball: roll      ball: pitch\n";
    for (const PatchFigures& patch : press.patches) {
        text += formatted("%-18s  %5.2f", name_of(patch).c_str(), 1.0 / patch.flat);
        for (std::size_t s = 0; s < 2; ++s)
            for (std::size_t t = 0; t < 2; ++t)
                text += formatted("   %5.3f (%5.3f)", patch.departures[s][t].rms, patch.departures[s][t].worst);
        text += is_default(figures, patch) ? "   <- burin hand\n" : "\n";
    }
    text += "\nWhere the force is made, simulated:\n";
    text += "made at       bit/s   sets/s   stiffest that rests N/m   lag ms   force error\n";
    for (const LineFigures& line : figures.lines) {
        const bool is_local = line.at == MadeAt::controller;
        text += formatted("%-10s  %7s  %7s   %23.0f   %6.1f   %11.3f\n", place_of(line.at),
                          is_local ? "any" : formatted("%.0f", line.bits_per_s).c_str(),
                          is_local ? "-" : formatted("%.0f", line.sets_per_s).c_str(), line.stiffest_N_per_m,
                          1e3 * line.lag_s, line.force_error);
    }
    if (!figures.trials.empty())
        text += formatted(
            "\nThe same on the emulated glove and its line of 38,400 bit/s; lag and error at %g N/m:\n"
            "made at      stiffest that rests N/m   lag ms   force error\n",
            kSoft_N_per_m);
    for (const TrialFigures& trial : figures.trials)
        text += formatted("%-10s   %23.0f   %6.1f   %11.3f\n", place_of(trial.at), trial.stiffest_N_per_m,
                          1e3 * trial.lag_s, trial.force_error);
    if (figures.measured_sets_per_s > 0.0)
        text += formatted("\nThe emulated glove's line brought %.1f sets with forces a second.\n",
                          figures.measured_sets_per_s);
    return text;
}

Json glove_json(const GloveFigures& figures) {
    Json json;
    json["depth_m"] = figures.task.depth_m;
    json["ball_m"] = figures.task.ball_m;
    json["pad_m"] = figures.press.pad_m;
    json["pad_points"] = figures.task.reference_points;
    json["patches"] = Json::array();
    for (const PatchFigures& patch : figures.press.patches) {
        Json row{{"points", patch.points}, {"extent_m", patch.extent_m}, {"flat_over_pad", patch.flat}};
        for (std::size_t s = 0; s < 2; ++s)
            for (std::size_t t = 0; t < 2; ++t) {
                const std::string name = std::string(kSurfaceNames[s]) + "_" + kTurnNames[t];
                const Departure& d = patch.departures[s][t];
                row[name] = {{"rms", d.rms}, {"worst", d.worst}, {"worst_rad", d.worst_rad}};
                const Departure& own = patch.of_own_extent[s][t];
                row[name + "_own_extent"] = {{"rms", own.rms}, {"worst", own.worst}};
            }
        json["patches"].push_back(std::move(row));
    }
    json["lines"] = Json::array();
    for (const LineFigures& line : figures.lines)
        json["lines"].push_back({{"made_at", place_of(line.at)},
                                 {"bits_per_s", line.bits_per_s},
                                 {"sets_per_s", line.sets_per_s},
                                 {"stiffest_N_per_m", line.stiffest_N_per_m},
                                 {"lag_s", line.lag_s},
                                 {"force_error", line.force_error}});
    json["emulated"] = Json::array();
    for (const TrialFigures& trial : figures.trials)
        json["emulated"].push_back({{"made_at", place_of(trial.at)},
                                    {"stiffest_N_per_m", trial.stiffest_N_per_m},
                                    {"lag_s", trial.lag_s},
                                    {"force_error", trial.force_error}});
    json["default_points"] = figures.default_points;
    json["default_extent_m"] = figures.default_extent_m;
    json["measured_sets_per_s"] = figures.measured_sets_per_s > 0.0 ? Json(figures.measured_sets_per_s) : Json(nullptr);
    return json;
}

std::string glove_svg(const GloveFigures& figures) {
    return plot::svg_figure("What a few points feel of a fingertip",
                            {forces_plot(figures.press, 0), forces_plot(figures.press, 1),
                             departures_plot(figures.press, 0), departures_plot(figures.press, 1)},
                            2);
}

}  // namespace burin::bench
