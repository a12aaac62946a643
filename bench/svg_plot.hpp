// SPDX-License-Identifier: MIT
// A figure of line plots with logarithmic axes, side by side with one legend, as SVG text that browsers and rsvg-convert
// show alike. The same input gives the same text.
#pragma once

#include <string>
#include <vector>

namespace burin::bench {

struct PlotPoint {
    double x = 0.0, y = 0.0;  // above zero; a point that is not, or not finite, is left out
    std::string label;        // written beside the point; may be empty
};

struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;  // joined in this order
};

struct Plot {
    std::string title, x_label, y_label;
    std::vector<PlotSeries> series;  // of one name in several plots: drawn alike, listed once
};

[[nodiscard]] std::string svg_figure(const std::string& title, const std::vector<Plot>& plots);

}  // namespace burin::bench
