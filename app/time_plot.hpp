// SPDX-License-Identifier: MIT
// A figure of line plots over time with linear axes, in a grid, as SVG text that browsers and rsvg-convert show alike. The same
// input gives the same text. Lines of some thousand points are meant; whoever has more thins them out first.
#pragma once

#include <string>
#include <vector>

namespace burin {

struct TimeSeries {
    std::string name;
    std::vector<double> values;  // one for each time; one that is not finite breaks the line
};

struct TimePlot {
    std::string title, y_label;
    std::vector<double> times_s;
    std::vector<TimeSeries> series;
};

// Filled row by row. Of each plot the legend stands in its upper margin.
[[nodiscard]] std::string time_figure(const std::string& title, const std::vector<TimePlot>& plots,
                                      std::size_t columns);

}  // namespace burin
