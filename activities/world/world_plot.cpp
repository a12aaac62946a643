// SPDX-License-Identifier: MIT
#include "activities/world/world_plot.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "base/plot/figures.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

constexpr std::size_t kMostLines = 7;  // as many as have a colour of their own and stand side by side in a legend
// An object that was not touched for so long has a gap in its line.
constexpr double kBreak_s = 0.025;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// A line for each object, broken where something else was touched, or nothing.
plot::TimePlot plot_of(const std::string& title, const std::string& unit, const std::vector<double>& times_s,
                       const std::vector<const ObjectTouch*>& objects,
                       const std::function<double(const TouchedPoint&)>& reading) {
    plot::TimePlot made{title, unit, times_s, {}};
    for (const ObjectTouch* object : objects) {
        plot::TimeSeries series{object->name, std::vector<double>(times_s.size(), kNothing)};
        for (const TouchedPoint& point : object->course) {
            const auto at = std::ranges::lower_bound(times_s, point.time_s);
            series.values[static_cast<std::size_t>(at - times_s.begin())] = reading(point);
        }
        made.series.push_back(std::move(series));
    }
    return made;
}

}  // namespace

std::string world_figure(const WorldFigures& figures) {
    std::vector<const ObjectTouch*> objects;
    std::set<double> instants_s{0.0, figures.felt.duration_s};
    for (const ObjectTouch& touch : figures.touches) {
        objects.push_back(&touch);
        double before_s = touch.first_s;
        for (const TouchedPoint& point : touch.course) {
            if (point.time_s - before_s > kBreak_s) instants_s.insert(0.5 * (before_s + point.time_s));
            instants_s.insert(before_s = point.time_s);
        }
    }
    std::ranges::stable_sort(objects, std::greater(), [](const ObjectTouch* touch) { return touch->updates; });
    const bool all = objects.size() <= kMostLines;
    if (!all) objects.resize(kMostLines);
    std::ranges::stable_sort(objects, {}, [](const ObjectTouch* touch) { return touch->first_s; });
    const std::vector<double> times_s(instants_s.begin(), instants_s.end());
    return plot::time_figure(
        all ? "What was felt of each object" : "What was felt of the objects touched longest",
        {plot_of("Force on the hand", "N", times_s, objects, [](const TouchedPoint& p) { return p.force_N; }),
         plot_of("Hand beyond where its tool rests", "mm", times_s, objects,
                 [](const TouchedPoint& p) { return 1e3 * p.beyond_m; })},
        1);
}

std::string depth_figure(const WorldFigures& figures) {
    plot::Plot made{"Force on the hand over its depth", "mm", "N", {}};
    made.x_linear = made.y_linear = true;
    made.markers = false;
    std::vector<const ObjectTouch*> objects;
    for (const ObjectTouch& touch : figures.touches) objects.push_back(&touch);
    std::ranges::stable_sort(objects, std::greater(), [](const ObjectTouch* t) { return t->wall.felt_N_per_m(); });
    for (const ObjectTouch* object : objects) {
        plot::PlotSeries series{formatted("%s, %.0f N/m", object->name.c_str(), object->wall.felt_N_per_m()), {}};
        for (const TouchedPoint& point : object->course)
            series.points.push_back({1e3 * point.beyond_m / figures.felt.object_from_device.scale, point.force_N, ""});
        made.series.push_back(std::move(series));
    }
    return plot::svg_figure("What was felt of each object", {made});
}

}  // namespace burin::activities
