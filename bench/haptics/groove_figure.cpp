// SPDX-License-Identifier: MIT
#include "bench/haptics/groove_figure.hpp"

#include <algorithm>

#include "base/csv.hpp"
#include "base/plot/figures.hpp"
#include "base/try.hpp"
#include "bench/haptics/carving_hand.hpp"
#include "bench/haptics/carving_scenes.hpp"

namespace burin::bench {
namespace {

constexpr const char *kSinks = "sinks", *kLifted = "lifted", *kLaw = "law", *kNow = "now";
constexpr std::string_view kHeader = "kind,tool,what,resolution,x,y";
constexpr std::size_t kGrooveColumns = 6, kPlotsInRow = 3;

Result<GroovePoint> groove_point_of(std::string_view line, const std::string& place) {
    const std::vector<CsvField> fields = split_csv(line).fields;
    const auto bad = [&](const std::string& why) {
        return fail(place, why, "give a file that bench haptics --groove has written");
    };
    if (fields.size() != kGrooveColumns) return bad("has " + std::to_string(fields.size()) + " fields in place of 6");
    GroovePoint point{fields[0].text, fields[1].text, fields[2].text};
    if (point.kind != kSinks && point.kind != kLifted) return bad("is of no curve known here: " + point.kind);
    const auto resolution = finite_number(fields[3].text), x = finite_number(fields[4].text),
               y = finite_number(fields[5].text);
    if (!resolution || !x || !y || *resolution < 0.0 || *resolution > 1e6) return bad("has no numbers at its end");
    point.resolution = static_cast<int>(*resolution);
    point.x = *x;
    point.y = *y;
    return point;
}

// One plot for each tool, in the order of the points, of series named by the points.
template <typename NameOf>
std::vector<plot::Plot> plots_of(const std::vector<GroovePoint>& points, const char* kind, const NameOf& name_of) {
    std::vector<plot::Plot> plots;
    for (const GroovePoint& point : points) {
        if (point.kind != kind) continue;
        auto plot = std::ranges::find(plots, point.tool, &plot::Plot::title);
        if (plot == plots.end()) {
            plot::Plot added;
            added.title = point.tool;
            added.x_linear = added.y_linear = true;
            plot = plots.insert(plots.end(), added);
        }
        const std::string name = name_of(point);
        auto series = std::ranges::find(plot->series, name, &plot::PlotSeries::name);
        if (series == plot->series.end())
            series = plot->series.insert(series, plot::PlotSeries{.name = name, .points = {}});
        series->points.push_back({point.x, point.y, ""});
    }
    return plots;
}

std::string lattice_of(const GroovePoint& point) { return "N = " + std::to_string(point.resolution); }

}  // namespace

std::vector<GroovePoint> measure_groove(const GrooveOptions& options,
                                        const std::function<void(const std::string&)>& notify) {
    std::vector<GroovePoint> points;
    for (const CarvingTool& tool : options.tools) {
        bool breaks = false;
        for (const int resolution : options.resolutions)
            for (const double press : options.presses) {
                notify(tool.name + ", " + std::to_string(resolution) + " cells, pressed");
                const Sunk sunk = sink(tool.shape, resolution, press, options.pressed_from_m);
                if (resolution == options.resolutions.front() && press > 1.0 && !breaks) {
                    points.push_back({kSinks, tool.name, kLaw, resolution, 1.0, 0.0});  // where the law breaks off
                    breaks = true;
                }
                if (resolution == options.resolutions.front())
                    points.push_back({kSinks, tool.name, kLaw, resolution, press, 1e3 * sunk.law_m_per_s});
                points.push_back({kSinks, tool.name, kNow, resolution, press, 1e3 * sunk.found_m_per_s});
            }
        notify(tool.name + ", lifted");
        const Lifted lifted = lift_out(tool.shape, options.lifted_resolution, options.lifted_at_m_per_s);
        for (const LiftedTick& tick : lifted.way)
            points.push_back({kLifted, tool.name, kNow, options.lifted_resolution, 1e3 * tick.height_m, tick.given_N});
    }
    return points;
}

std::string groove_csv(const std::vector<GroovePoint>& points) {
    std::string text = std::string(kHeader) + "\n";
    for (const GroovePoint& p : points)
        text += csv_field(p.kind) + "," + csv_field(p.tool) + "," + csv_field(p.what) + "," +
                std::to_string(p.resolution) + "," + csv_number(p.x) + "," + csv_number(p.y) + "\n";
    return text;
}

Result<std::vector<GroovePoint>> groove_points(std::string_view csv, const std::string& name,
                                               const std::string& version) {
    std::vector<GroovePoint> points;
    for (std::size_t line = 1; !csv.empty(); ++line) {
        const CsvRecord record = take_record(csv, ',');
        if (line == 1 && record.text == kHeader) continue;
        BURIN_TRY(point, groove_point_of(record.text, name + ", line " + std::to_string(line)));
        if (point.what == kNow) point.what = version;
        points.push_back(std::move(point));
    }
    if (points.empty()) return fail(name, "has no points", "give a file that bench haptics --groove has written");
    return points;
}

std::string sinking_svg(const std::vector<GroovePoint>& points) {
    std::vector<plot::Plot> plots = plots_of(points, kSinks, [](const GroovePoint& p) {
        if (p.what == kLaw) return std::string(kLaw);
        return p.what == kNow ? lattice_of(p) : p.what + ", " + lattice_of(p);
    });
    for (plot::Plot& plot : plots) {
        plot.x_label = "press, in yields of the section";
        plot.y_label = "sinks at, mm/s";
    }
    return plot::svg_figure("How fast a pressed tool sinks, 3 mm deep in medium material", plots, kPlotsInRow);
}

std::string lifted_svg(const std::vector<GroovePoint>& points) {
    std::vector<plot::Plot> plots = plots_of(points, kLifted, [](const GroovePoint& p) { return p.what; });
    double most_N = 0.1;
    for (const GroovePoint& point : points)
        if (point.kind == kLifted) most_N = std::max(most_N, point.y);
    for (plot::Plot& plot : plots) {
        plot.x_label = "above the groove's floor, mm";
        plot.y_label = "force, N";
        plot.y_highest = most_N;
        plot.markers = false;
    }
    return plot::svg_figure("What holds a tool that is lifted out of its groove", plots, kPlotsInRow);
}

}  // namespace burin::bench
