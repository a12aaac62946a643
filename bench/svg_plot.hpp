// SPDX-License-Identifier: MIT
// A figure of line plots with logarithmic or linear axes, side by side with one legend, as SVG text that browsers and
// rsvg-convert show alike. The same input gives the same text.
#pragma once

#include <string>
#include <vector>

namespace burin::bench {

struct PlotPoint {
    double x = 0.0,
           y = 0.0;     // above zero where the axis is logarithmic; a point that is not, or not finite, is left out
    std::string label;  // written beside the point; may be empty
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;  // joined in this order
};

struct Plot {
    std::string title, x_label, y_label;
    std::vector<PlotSeries> series;  // of one name in several plots: drawn alike, listed once
    bool x_linear = false, y_linear = false;
    bool markers = true;  // false: a line alone, for curves of many points
    double y_lowest = 0,
           y_highest = 0;  // what the axis shows at least, so that plots side by side compare; equal: as needed
};

[[nodiscard]] std::string svg_figure(const std::string& title, const std::vector<Plot>& plots);

}  // namespace burin::bench
