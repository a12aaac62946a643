// SPDX-License-Identifier: MIT
#include "study/report/strip_plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/plot/svg.hpp"
#include "base/statistics.hpp"

namespace burin::study {
namespace {

constexpr double kWidth = 420.0, kHeight = 300.0, kLeft = 62.0, kRight = 12.0, kTop = 34.0, kBottom = 30.0;
constexpr double kDotRadius = 4.0;

struct Axis {
    double step = 1.0, top = 1.0;
    [[nodiscard]] double y_of(double value) const {
        return kHeight - kBottom - value / top * (kHeight - kTop - kBottom);
    }
};

Axis axis_for(const std::vector<Strip>& strips) {
    double largest = 0.0;
    for (const Strip& strip : strips) {
        for (const double value : strip.values) largest = std::isfinite(value) ? std::max(largest, value) : largest;
    }
    if (largest <= 0.0) return {};
    const double step = plot::round_step(largest / 5.0);
    return {.step = step, .top = step * std::ceil(largest / step)};
}

std::string grid(const Axis& axis) {
    std::string text;
    for (int i = 0; i <= static_cast<int>(std::lround(axis.top / axis.step)); ++i) {
        const double value = i * axis.step, y = axis.y_of(value);
        text += plot::line_across(kLeft, y, kWidth - kLeft - kRight, i == 0 ? "#333333" : "#dddddd");
        text += plot::write(kLeft - 6.0, y + 4.0, "text-anchor=\"end\"", formatted("%g", value));
    }
    return text;
}

std::string dot(double x, double y, const std::string& label) {
    return formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\" fill-opacity=\"0.55\" stroke=\"#000000\">",
                     x, y, kDotRadius, plot::colour_of(0)) +
           "<title>" + plot::escaped(label) + "</title></circle>\n";
}

// Dots side by side where they would cover each other: each goes to the first free place, outwards from the middle.
std::string dots(const Strip& strip, const Axis& axis, double middle) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < strip.values.size(); ++i) {
        if (std::isfinite(strip.values[i])) order.push_back(i);
    }
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return strip.values[i]; });
    std::vector<double> last_y(21, 1e9);  // by place
    std::string text;
    for (const std::size_t i : order) {
        const double y = axis.y_of(strip.values[i]);
        std::size_t place = 0;
        while (place + 1 < last_y.size() && last_y[place] - y < 2.0 * kDotRadius) ++place;
        last_y[place] = y;
        const double side = place % 2 == 1 ? 1.0 : -1.0;
        const double x = middle + side * static_cast<double>((place + 1) / 2) * 2.2 * kDotRadius;
        text += dot(x, y, strip.labels[i] + ": " + formatted("%.6g", strip.values[i]));
    }
    return text;
}

std::string median_bar(std::vector<double> values, const Axis& axis, double middle) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty()) return "";
    const double median = middle_value(std::move(values));
    const double y = axis.y_of(median);
    return plot::line(middle - 34.0, y, middle + 34.0, y, "#000000", " stroke-width=\"2.5\"") +
           plot::write(middle + 38.0, y + 4.0, "", formatted("%.3g", median));
}

}  // namespace

std::string strip_plot(const std::string& title, const std::string& axis_name, const std::vector<Strip>& strips) {
    const Axis axis = axis_for(strips);
    std::string text = plot::svg_begin(kWidth, kHeight, title, 20.0) + grid(axis);
    text += plot::write_upright(14.0, 0.5 * (kTop + kHeight - kBottom), axis_name);
    const double width = (kWidth - kLeft - kRight) / static_cast<double>(std::max<std::size_t>(1, strips.size()));
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const double middle = kLeft + (static_cast<double>(i) + 0.5) * width;
        text += dots(strips[i], axis, middle) + median_bar(strips[i].values, axis, middle);
        text += plot::write(middle, kHeight - 10.0, "text-anchor=\"middle\"",
                            formatted("%s (n = %zu)", strips[i].name.c_str(), strips[i].values.size()));
    }
    return text + "</svg>\n";
}

}  // namespace burin::study
