// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/plot/figures.hpp"
#include "base/plot/svg.hpp"

namespace burin::plot {
namespace {

// Lengths in pixels. A plot's frame within its cell leaves room for the labels.
constexpr double kCellWidth = 430, kFrameLeft = 72, kFrameTop = 84, kFrameWidth = 335, kFrameHeight = 300;
constexpr double kRowHeight = kFrameHeight + 84;  // from one row of plots to the next
constexpr double kLegendRow = 20, kLegendColumn = 430;

bool drawable(const Plot& plot, const PlotPoint& p) {
    return (plot.x_linear || p.x > 0.0) && (plot.y_linear || p.y > 0.0) && std::isfinite(p.x) && std::isfinite(p.y);
}

// Maps values to positions along the axis, 0 to 1.
struct Axis {
    bool linear = false;
    bool whole = false;  // of whole numbers, with ticks at such alone
    // The range shown: of the values on a linear axis, else of their log10.
    double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();

    [[nodiscard]] double scaled(double value) const { return linear ? value : std::log10(value); }
    void include(double value) {
        lo = std::min(lo, scaled(value));
        hi = std::max(hi, scaled(value));
    }
    // Adds a margin on both sides, and makes a logarithmic axis at least one decade long, so that there are ticks.
    void widen() {
        if (lo > hi) lo = hi = 0.0;
        double margin = 0.08 * (hi - lo);
        if (!linear) margin = std::max(margin, 0.5 * (1.0 - (hi - lo)));
        if (linear && !(margin > 0.0)) margin = whole ? 0.5 : 1.0;
        lo -= margin;
        hi += margin;
    }
    // Adds as much on both sides as makes it so long.
    void lengthen(double length) {
        const double margin = std::max(0.0, 0.5 * (length - (hi - lo)));
        lo -= margin;
        hi += margin;
    }
    [[nodiscard]] double place(double value) const { return (scaled(value) - lo) / (hi - lo); }
    [[nodiscard]] bool holds(double value) const { return place(value) >= 0.0 && place(value) <= 1.0; }
};

struct Frame {
    double left = 0.0, top = kFrameTop;
    Axis x, y;
    [[nodiscard]] double at_x(double value) const { return left + kFrameWidth * x.place(value); }
    [[nodiscard]] double at_y(double value) const { return top + kFrameHeight * (1.0 - y.place(value)); }
};

// Formats as 0.001, 0.2, 50, or 1e-05 where that is shorter.
std::string tick_label(double value, const std::string& decimal) {
    std::string label = formatted("%.12g", value);
    if (const std::size_t point = label.find('.'); point != std::string::npos) label.replace(point, 1, decimal);
    return label;
}

// Calls draw(value, strong, labelled) at multiples of 1, 2 or 5 times a power of ten, about five to a linear axis.
template <typename Draw>
void linear_ticks(const Axis& axis, Draw&& draw) {
    const double wanted = (axis.hi - axis.lo) / 5.0, power = std::pow(10.0, std::floor(std::log10(wanted)));
    const double round = power * (wanted < 2.0 * power ? 1.0 : wanted < 5.0 * power ? 2.0 : 5.0);
    const double step = axis.whole ? std::max(round, 1.0) : round;
    for (double i = std::ceil(axis.lo / step); i * step <= axis.hi; ++i)
        draw(i * step + 0.0, i == 0.0, true);  // + 0: no -0
}

std::string grid_of(const Frame& f, const std::string& decimal) {
    std::string text;
    const auto ticks = [](const Axis& axis, auto&& draw) {
        if (axis.linear) return linear_ticks(axis, draw);
        const bool few_decades = axis.hi - axis.lo < 2.5;
        for (int decade = static_cast<int>(std::floor(axis.lo)); decade <= axis.hi; ++decade) {
            for (const int step : {1, 2, 5}) {
                const double value = step * std::pow(10.0, decade);
                if (axis.holds(value)) draw(value, step == 1, step == 1 || few_decades);
            }
        }
    };
    ticks(f.x, [&](double value, bool strong, bool labelled) {
        const double x = f.at_x(value);
        text += line(x, f.top, x, f.top + kFrameHeight, strong ? "#bbbbbb" : "#e6e6e6");
        if (labelled) text += write(x, f.top + kFrameHeight + 16, "text-anchor=\"middle\"", tick_label(value, decimal));
    });
    ticks(f.y, [&](double value, bool strong, bool labelled) {
        const double y = f.at_y(value);
        text += line(f.left, y, f.left + kFrameWidth, y, strong ? "#bbbbbb" : "#e6e6e6");
        if (labelled) text += write(f.left - 6, y + 4, "text-anchor=\"end\"", tick_label(value, decimal));
    });
    return text + rectangle(f.left, f.top, kFrameWidth, kFrameHeight, "none", "#444444");
}

// Draws a filled shape that goes with the colour, so that series differ in print too.
std::string marker(std::size_t style, double x, double y) {
    const char* colour = colour_of(style);
    constexpr double r = 4.5;
    switch (style % 4) {
        case 0: return formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/>\n", x, y, r, colour);
        case 1:
            return formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", x - 4, y - 4,
                             8.0, 8.0, colour);
        case 2: return formatted("<path d=\"M%.1f %.1f l5 9 h-10 z\" fill=\"%s\"/>\n", x, y - 6, colour);
        default: return formatted("<path d=\"M%.1f %.1f l6 6 l-6 6 l-6 -6 z\" fill=\"%s\"/>\n", x, y - 6, colour);
    }
}

// Returns how a line without markers is dashed, so that series differ without colours too.
const char* dashes(std::size_t style) {
    constexpr std::array kDashes{"", " stroke-dasharray=\"7 3\"", " stroke-dasharray=\"2 3\"",
                                 " stroke-dasharray=\"9 3 2 3\""};
    return kDashes[(style + style / kColours.size()) % kDashes.size()];  // where colours come again, too
}

double width_of(const Plot& plot, const PlotSeries& series) {
    return series.width > 0.0 ? series.width : plot.markers ? 1.8 : 1.0;
}

// A name of the legend and how its series are drawn.
struct NamedStyle {
    std::string name;
    std::size_t style = 0;
};

// Each name once, in the order of the series; one that is like another has its style.
std::vector<NamedStyle> styles_of(const std::vector<Plot>& plots) {
    std::vector<NamedStyle> styles;
    std::size_t next = 0;
    for (const Plot& plot : plots) {
        for (const PlotSeries& s : plot.series) {
            if (std::ranges::find(styles, s.name, &NamedStyle::name) != styles.end()) continue;
            const auto like = std::ranges::find(styles, s.like, &NamedStyle::name);
            styles.push_back({s.name, s.style                                  ? *s.style
                                      : s.like.empty() || like == styles.end() ? next++
                                                                               : like->style});
        }
    }
    return styles;
}

// Draws what stands before a name in the legend: a piece of the series' line where it has no marker or a width of its
// own, and its marker.
std::string legend_sign(const std::vector<Plot>& plots, const NamedStyle& of, double x, double y) {
    for (const Plot& plot : plots) {
        const auto series = std::ranges::find(plot.series, of.name, &PlotSeries::name);
        if (series == plot.series.end() || (plot.markers && !(series->width > 0.0))) continue;
        return line(x - 20, y, x + 6, y, colour_of(of.style),
                    formatted(" stroke-width=\"%g\"%s", width_of(plot, *series), plot.markers ? "" : dashes(of.style))
                        .c_str()) +
               (plot.markers ? marker(of.style, x - 7, y) : "");
    }
    return marker(of.style, x, y);
}

std::string line_through(const Plot& plot, const PlotSeries& series, std::size_t style, const Frame& f) {
    std::string path, points;
    for (const PlotPoint& p : series.points) {
        if (!drawable(plot, p)) continue;
        const double x = f.at_x(p.x), y = f.at_y(p.y);
        path += formatted("%s%.1f %.1f", path.empty() ? "M" : " L", x, y);
        if (plot.markers) points += marker(style, x, y);
        if (p.label.empty()) continue;
        const bool room = x + 7 + 6.2 * static_cast<double>(p.label.size()) < f.left + kFrameWidth;  // to the right
        points +=
            write(room ? x + 7 : x - 7, y - 6,
                  room ? "font-size=\"10\" fill=\"#444444\"" : "font-size=\"10\" fill=\"#444444\" text-anchor=\"end\"",
                  p.label);
    }
    if (path.empty()) return "";
    return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour_of(style) +
           formatted("\" stroke-width=\"%g\"%s/>\n", width_of(plot, series), plot.markers ? "" : dashes(style)) +
           points;
}

std::string plot_text(const Plot& plot, double left, double top, const std::vector<NamedStyle>& names) {
    Frame f;
    f.left = left + kFrameLeft;
    f.top = top + kFrameTop;
    f.x.linear = plot.x_linear;
    f.x.whole = plot.x_whole;
    f.y.linear = plot.y_linear;
    if (plot.y_lowest < plot.y_highest) {
        f.y.include(plot.y_lowest);
        f.y.include(plot.y_highest);
    }
    for (const PlotSeries& s : plot.series) {
        for (const PlotPoint& p : s.points) {
            if (!drawable(plot, p)) continue;
            f.x.include(p.x);
            f.y.include(p.y);
        }
    }
    f.x.widen();
    f.y.widen();
    if (plot.same_scale) {
        const double per_pixel = std::max((f.x.hi - f.x.lo) / kFrameWidth, (f.y.hi - f.y.lo) / kFrameHeight);
        f.x.lengthen(per_pixel * kFrameWidth);
        f.y.lengthen(per_pixel * kFrameHeight);
    }
    const double middle = f.left + kFrameWidth / 2, half_up = f.top + kFrameHeight / 2;
    std::string text = grid_of(f, plot.decimal);
    text += write(middle, f.top - 12, "text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\"", plot.title);
    text += write(middle, f.top + kFrameHeight + 38, "text-anchor=\"middle\"", plot.x_label);
    text += write_upright(left + 16, half_up, plot.y_label);
    for (const PlotSeries& s : plot.series)
        text += line_through(plot, s, std::ranges::find(names, s.name, &NamedStyle::name)->style, f);
    return text;
}

}  // namespace

std::string svg_figure(const std::string& title, const std::vector<Plot>& plots, std::size_t columns) {
    const std::vector<NamedStyle> names = styles_of(plots);
    const std::size_t across = std::max<std::size_t>(1, columns > 0 ? std::min(columns, plots.size()) : plots.size());
    const std::size_t rows = std::max<std::size_t>(1, (plots.size() + across - 1) / across);
    const double width = kCellWidth * static_cast<double>(across);
    const auto legends = static_cast<std::size_t>(std::max(1.0, std::floor(width / kLegendColumn)));
    const double legend_top = kFrameTop + kRowHeight * static_cast<double>(rows) - 18;
    const double height = legend_top + kLegendRow * static_cast<double>((names.size() + legends - 1) / legends) + 6;
    std::string text = svg_begin(width, height, title, 30);
    for (std::size_t i = 0; i < plots.size(); ++i) {
        text += plot_text(plots[i], kCellWidth * static_cast<double>(i % across),
                          kRowHeight * static_cast<double>(i / across), names);
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double x = kFrameLeft + kLegendColumn * static_cast<double>(i % legends);
        const double y = legend_top + kLegendRow * static_cast<double>(i / legends);
        text += legend_sign(plots, names[i], x, y) + write(x + 12, y + 4, "font-size=\"12\"", names[i].name);
    }
    return text + "</svg>\n";
}

}  // namespace burin::plot
