// SPDX-License-Identifier: MIT
#include "study/report/trial_figures.hpp"

#include <algorithm>
#include <array>

#include "base/plot/figures.hpp"
#include "study/metrics/even_motion.hpp"

namespace burin::study {
namespace {

constexpr std::size_t kPointsOfLine = 400;
constexpr std::array kPointNames{"top point", "bottom point"};
constexpr std::array kAxisNames{"x", "y", "z"};

// Every so manieth tick is drawn, and the last.
std::vector<std::size_t> drawn_ticks(std::size_t ticks) {
    std::vector<std::size_t> drawn;
    const std::size_t stride = std::max<std::size_t>(1, ticks / kPointsOfLine);
    for (std::size_t i = 0; i < ticks; i += stride) drawn.push_back(i);
    if (!drawn.empty() && drawn.back() + 1 != ticks) drawn.push_back(ticks - 1);
    return drawn;
}

plot::PlotSeries line_of(const std::string& name, const std::vector<Vec3>& places, int across, int up, double width) {
    plot::PlotSeries series{name, {}, width};
    for (const std::size_t i : drawn_ticks(places.size()))
        series.points.push_back({1000.0 * places[i][across], 1000.0 * places[i][up], ""});
    return series;
}

std::string path_figure(const ShownTrial& trial) {
    const auto view = [&](const char* title, int up, const char* label) {
        plot::Plot plot{title, "x (mm)", label, {}, true, true, false};
        plot.same_scale = true;
        plot.series.push_back(line_of(kPointNames[0], trial.model.points_m[0], 0, up, 2.0));
        plot.series.push_back(line_of(kPointNames[1], trial.model.points_m[1], 0, up, 1.6));
        plot.series.push_back(line_of("axis of the tube", trial.world->spine_m, 0, up, 1.4));
        return plot;
    };
    return plot::svg_figure("Path, " + trial.name,
                            {view("from the front", 1, "y (mm)"), view("from above", 2, "z (mm)")}, 1);
}

// Three plots, one for each axis, of a vector over the time since the clock's start; the model ticks at an even rate.
std::string axes_figure(const std::string& title, const char* quantity, const std::vector<Vec3>& vectors,
                        double factor) {
    std::vector<plot::TimePlot> plots;
    const std::vector<std::size_t> drawn = drawn_ticks(vectors.size());
    for (int axis = 0; axis < 3; ++axis) {
        plot::TimePlot plot{std::string("along ") + kAxisNames[static_cast<std::size_t>(axis)], quantity, {}, {}};
        plot::TimeSeries series{"", {}};
        for (const std::size_t i : drawn) {
            plot.times_s.push_back(static_cast<double>(i) / kEvenRate_Hz);
            series.values.push_back(factor * vectors[i][axis]);
        }
        plot.series.push_back(std::move(series));
        plots.push_back(std::move(plot));
    }
    return plot::time_figure(title, plots, 1);
}

}  // namespace

std::vector<std::string> trial_figures(const ShownTrial& trial) {
    std::vector<std::string> figures{path_figure(trial)};
    for (std::size_t p = 0; p < kPointNames.size(); ++p) {
        std::vector<Vec3> deviations_m;
        for (std::size_t i = 0; i < trial.model.points_m[p].size(); ++i)
            deviations_m.push_back(trial.model.points_m[p][i] - trial.model.collision_points_m[p][i]);
        figures.push_back(axes_figure(std::string("Deviation of the ") + kPointNames[p], "mm", deviations_m, 1000.0));
    }
    for (std::size_t p = 0; p < kPointNames.size(); ++p)
        figures.push_back(
            axes_figure(std::string("Force on the ") + kPointNames[p], "N", trial.model.forces_N[p], 1.0));
    return figures;
}

}  // namespace burin::study
