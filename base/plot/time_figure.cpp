// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "base/plot/figures.hpp"
#include "base/plot/svg.hpp"

namespace burin::plot {
namespace {

// Lengths in pixels.
constexpr double kTimeCellWidth = 560, kTimeCellHeight = 270, kLeft = 66, kTimeTop = 44, kWidth = 474, kHeight = 176,
                 kHeader = 44;

struct TimeAxis {
    double lo = 0.0, hi = 0.0, step = 1.0;

    // Chooses a round step, about five of them to the axis.
    static TimeAxis around(double lo, double hi) {
        if (!(hi > lo)) hi = lo + 1.0;
        const double step = round_step((hi - lo) / 5.0);
        return {step * std::floor(lo / step), step * std::ceil(hi / step), step};
    }
    [[nodiscard]] double place(double value) const { return (value - lo) / (hi - lo); }
};

struct TimeFrame {
    double left, top;
    TimeAxis x, y;
    [[nodiscard]] double at_x(double value) const { return left + kWidth * x.place(value); }
    [[nodiscard]] double at_y(double value) const { return top + kHeight * (1.0 - y.place(value)); }
};

TimeAxis values_of(const TimePlot& plot) {
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (const TimeSeries& s : plot.series)
        for (const double v : s.values)
            if (std::isfinite(v)) lo = std::min(lo, v), hi = std::max(hi, v);
    return lo <= hi ? TimeAxis::around(lo, hi) : TimeAxis::around(0.0, 1.0);
}

std::string label(double value, double step) {
    const int digits = static_cast<int>(std::clamp(std::ceil(-std::log10(step) - 1e-9), 0.0, 6.0));
    return formatted("%.*f", digits, std::abs(value) < 1e-6 * step ? 0.0 : value);
}

std::string time_grid(const TimeFrame& f) {
    std::string text;
    for (double v = f.x.lo; v <= f.x.hi + 0.5 * f.x.step; v += f.x.step) {
        const double x = f.at_x(v);
        if (x > f.left + kWidth + 0.5) break;
        text += line_down(x, f.top, kHeight, "#dddddd");
        text += write(x, f.top + kHeight + 15, "text-anchor=\"middle\"", label(v, f.x.step));
    }
    for (double v = f.y.lo; v <= f.y.hi + 0.5 * f.y.step; v += f.y.step) {
        const double y = f.at_y(v);
        text += line_across(f.left, y, kWidth, "#dddddd");
        text += write(f.left - 6, y + 4, "text-anchor=\"end\"", label(v, f.y.step));
    }
    return text + rectangle(f.left, f.top, kWidth, kHeight, "none", "#444444");
}

std::string curve(const TimePlot& plot, const TimeSeries& series, const TimeFrame& f, const char* colour) {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < std::min(plot.times_s.size(), series.values.size()); ++i) {
        if (!std::isfinite(series.values[i])) {
            drawing = false;
            continue;
        }
        path += formatted("%s%.2f %.2f", drawing ? "L" : "M", f.at_x(plot.times_s[i]), f.at_y(series.values[i]));
        drawing = true;
    }
    if (path.empty()) return "";
    return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour +
           "\" stroke-width=\"1.1\" stroke-linejoin=\"round\"/>\n";
}

std::string legend(const TimePlot& plot, const TimeFrame& f) {
    std::string text;
    double x = f.left;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        if (plot.series[i].name.empty()) continue;  // the title says what it is
        text +=
            formatted("<path d=\"M%.1f %.1f h16\" stroke=\"%s\" stroke-width=\"2.5\"/>\n", x, f.top - 10, colour_of(i));
        text += write(x + 20, f.top - 6, "", plot.series[i].name);
        x += 34 + 6.3 * static_cast<double>(plot.series[i].name.size());
    }
    return text;
}

std::string plot_text(const TimePlot& plot, double left, double top) {
    const double end_s = plot.times_s.empty() ? 1.0 : plot.times_s.back();
    TimeAxis x = TimeAxis::around(plot.times_s.empty() ? 0.0 : plot.times_s.front(), end_s);
    x.hi = std::min(x.hi, std::max(end_s, x.lo + x.step));
    const TimeFrame f{left + kLeft, top + kTimeTop, x, values_of(plot)};
    std::string text = time_grid(f);
    text += write(f.left, f.top - 26, "font-size=\"13\" font-weight=\"bold\"", plot.title);
    text += write_upright(left + 14, f.top + kHeight / 2, plot.y_label);
    text += write(f.left + kWidth / 2, f.top + kHeight + 32, "text-anchor=\"middle\"", "time, s");
    for (std::size_t i = 0; i < plot.series.size(); ++i) text += curve(plot, plot.series[i], f, colour_of(i));
    return text + legend(plot, f);
}

}  // namespace

std::string time_figure(const std::string& title, const std::vector<TimePlot>& plots, std::size_t columns) {
    const std::size_t rows = (plots.size() + columns - 1) / columns;
    const double width = kTimeCellWidth * static_cast<double>(columns);
    const double height = kHeader + kTimeCellHeight * static_cast<double>(rows);
    std::string text = svg_begin(width, height, title, 28);
    for (std::size_t i = 0; i < plots.size(); ++i) {
        text += plot_text(plots[i], kTimeCellWidth * static_cast<double>(i % columns),
                          kHeader + kTimeCellHeight * static_cast<double>(i / columns));
    }
    return text + "</svg>\n";
}

}  // namespace burin::plot
