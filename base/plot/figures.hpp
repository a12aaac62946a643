// SPDX-License-Identifier: MIT
// Figures as SVG text that browsers and rsvg-convert show alike; the same input gives the same text. Three kinds: line
// plots with logarithmic or linear axes, line plots over time, and dot charts. They share the elements of svg.hpp.
// Any thread; allocates.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace burin::plot {

// ---- Line plots in rows with one legend (line_figure.cpp)

struct PlotPoint {
    // Above zero where the axis is logarithmic; other points, and those that are not finite, are left out.
    double x = 0.0, y = 0.0;
    std::string label;  // written beside the point; may be empty
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;  // joined in this order
    double width = 0.0;             // of the line, in pixels; 0: as the plot's others
    std::string like = {};          // the name of the series whose colour and sign it shares; empty: it has its own
    std::optional<std::size_t> style = {};  // of colours and signs, by number; none: by its place among the names
};

struct Plot {
    std::string title, x_label, y_label;
    std::vector<PlotSeries> series;  // series of one name in several plots are drawn alike and listed once
    bool x_linear = false, y_linear = false;
    bool markers = true;  // false: only lines, for curves of many points; each series is dashed in its own way
    // The least range that the y axis shows, so that plots side by side compare; equal values: as the series need.
    double y_lowest = 0, y_highest = 0;
    bool same_scale = false;    // both axes, which are linear: ways in space, where a circle is to be round
    bool x_whole = false;       // of a linear axis: days and the like, with no ticks between them
    std::string decimal = ".";  // sign of the ticks' numbers
};

// Draws the plots in rows of so many; 0: in one row.
[[nodiscard]] std::string svg_figure(const std::string& title, const std::vector<Plot>& plots, std::size_t columns = 0);

// ---- Line plots over time in a grid (time_figure.cpp), for lines of some thousand points; decimate longer ones first

struct TimeSeries {
    std::string name;
    std::vector<double> values;  // one for each time; a value that is not finite interrupts the line
};

struct TimePlot {
    std::string title, y_label;
    std::vector<double> times_s;
    std::vector<TimeSeries> series;
};

// Draws the plots row by row. Each plot's legend stands in its upper margin.
[[nodiscard]] std::string time_figure(const std::string& title, const std::vector<TimePlot>& plots,
                                      std::size_t columns);

// ---- Several measures of the same few subjects (dot_chart.cpp): one panel for each measure, one row for each subject,
// a dot for the value with a line to its upper quantile, and the number beside it

struct DotValue {
    double value = 0.0;  // not finite: no value, and the row says so
    double upper = 0.0;  // end of the line; no line unless above the value
};

struct DotPanel {
    std::string title;
    bool logarithmic = false;      // else from zero; a logarithmic panel has no dot for values that are not above zero
    int digits = 1;                // decimals of the numbers beside the dots
    std::vector<DotValue> values;  // one for each row
};

[[nodiscard]] std::string dot_chart(const std::string& title, const std::vector<std::string>& rows,
                                    const std::vector<DotPanel>& panels, const std::vector<std::string>& notes);

}  // namespace burin::plot
