// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "base/plot/figures.hpp"
#include "base/plot/svg.hpp"

namespace burin::plot {
namespace {

// Lengths in pixels. Three panels stand side by side; the names stand left of the first.
constexpr double kNames = 168, kPanelWidth = 262, kPlotWidth = 190, kTop = 84, kRow = 24, kBetween = 74, kNoteRow = 17;
constexpr std::size_t kAcross = 3;

// Returns a round step, about four of them to the span.
double tick_step(double span) { return round_step(span / 4.0); }

struct DotAxis {
    bool logarithmic;
    double lo = 0.0, hi = 1.0;  // in values, or in their log10

    explicit DotAxis(const DotPanel& panel) : logarithmic(panel.logarithmic) {
        double least = INFINITY, most = 0.0;
        for (const DotValue& v : panel.values) {
            if (!shown(v)) continue;
            least = std::min(least, v.value);
            most = std::max({most, v.value, v.upper});
        }
        if (logarithmic && most > 0.0) {
            lo = std::log10(least) - 0.15;
            hi = std::max(lo + 1.0, std::log10(most) + 0.1);
        } else if (most > 0.0) {
            const double step = tick_step(most);
            hi = step * std::ceil(most / step - 1e-9);
        }
    }
    [[nodiscard]] bool shown(const DotValue& v) const {
        return std::isfinite(v.value) && (!logarithmic || v.value > 0.0);
    }
    [[nodiscard]] double place(double value) const {
        return ((logarithmic ? std::log10(value) : value) - lo) / (hi - lo) * kPlotWidth;
    }
};

std::string grid_of(const DotAxis& axis, double left, double top, double height) {
    std::string text;
    const auto draw = [&](double value, bool labelled) {
        const double x = left + axis.place(value);
        text += line(x, top, x, top + height, labelled ? "#cccccc" : "#eeeeee");
        if (labelled) text += write(x, top + height + 14, "text-anchor=\"middle\"", formatted("%.6g", value));
    };
    if (!axis.logarithmic) {
        const double step = tick_step(axis.hi);
        for (int i = 0; i * step <= axis.hi * (1.0 + 1e-9); ++i) draw(i * step, true);
        return text;
    }
    for (int decade = static_cast<int>(std::floor(axis.lo)); decade <= axis.hi; ++decade) {
        for (const int times : {1, 2, 5}) {
            const double value = times * std::pow(10.0, decade), place = axis.place(value);
            if (place >= 0.0 && place <= kPlotWidth) draw(value, times == 1);
        }
    }
    return text;
}

std::string row_of(const DotAxis& axis, const DotValue& v, int digits, double left, double y, const char* colour) {
    if (!axis.shown(v)) {
        return write(left + 6, y + 4, "fill=\"#888888\"", std::isfinite(v.value) ? "0" : "never");
    }
    const double x = left + axis.place(v.value);
    const double end = v.upper > v.value ? left + axis.place(v.upper) : x;
    std::string text;
    if (!axis.logarithmic) {
        text += line(left, y, x, y, colour, " stroke-width=\"5\"");
    }
    text += line(x, y, end, y, colour, " stroke-width=\"1.5\"");
    if (end > x) {
        text += line(end, y - 4, end, y + 4, colour, " stroke-width=\"1.5\"");
    }
    text += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"%s\"/>\n", x, y, colour);
    return text + write(end + 9, y + 4, "fill=\"#222222\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"",
                        formatted("%.*f", digits, v.value));
}

std::string panel_of(const DotPanel& panel, std::size_t rows, double left, double top) {
    const DotAxis axis(panel);
    const double height = kRow * static_cast<double>(rows);
    std::string text = grid_of(axis, left, top, height);
    text += write(left + kPlotWidth / 2, top - 12, "text-anchor=\"middle\" font-size=\"12\" font-weight=\"bold\"",
                  panel.title);
    for (std::size_t i = 0; i < std::min(rows, panel.values.size()); ++i) {
        text += row_of(axis, panel.values[i], panel.digits, left, top + kRow * (static_cast<double>(i) + 0.5),
                       colour_of(i));
    }
    return text;
}

}  // namespace

std::string dot_chart(const std::string& title, const std::vector<std::string>& rows,
                      const std::vector<DotPanel>& panels, const std::vector<std::string>& notes) {
    const double block = kRow * static_cast<double>(rows.size()) + kBetween;
    const auto lines = static_cast<double>((panels.size() + kAcross - 1) / kAcross);
    const double width = kNames + kPanelWidth * static_cast<double>(kAcross);
    const double notes_top = kTop + lines * block - 26;
    std::string text = svg_begin(width, notes_top + kNoteRow * static_cast<double>(notes.size()) + 4, title, 30);
    for (std::size_t p = 0; p < panels.size(); ++p) {
        const double top = kTop + block * static_cast<double>(p / kAcross);
        const double left = kNames + kPanelWidth * static_cast<double>(p % kAcross);
        for (std::size_t i = 0; p % kAcross == 0 && i < rows.size(); ++i) {
            text += write(kNames - 10, top + kRow * (static_cast<double>(i) + 0.5) + 4,
                          "text-anchor=\"end\" font-size=\"12\"", rows[i]);
        }
        text += panel_of(panels[p], rows.size(), left, top);
    }
    for (std::size_t i = 0; i < notes.size(); ++i) {
        text += write(16, notes_top + kNoteRow * static_cast<double>(i), "fill=\"#444444\"", notes[i]);
    }
    return text + "</svg>\n";
}

}  // namespace burin::plot
