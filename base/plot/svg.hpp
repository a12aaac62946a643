// SPDX-License-Identifier: MIT
// Primitives that all figures are drawn with: elements of SVG as text, colours, and round steps for axes. Lengths are
// in pixels, y points down. The same arguments give the same text.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "base/text.hpp"

namespace burin::plot {

// Colours of Okabe and Ito, which people with any kind of colour vision can tell apart.
inline constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                     "#000000", "#e69f00", "#56b4e9", "#999999"};

// Returns the colour of a series; they begin again after the last.
[[nodiscard]] inline const char* colour_of(std::size_t series) { return kColours[series % kColours.size()]; }

[[nodiscard]] inline std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&') {
            safe += "&amp;";
        } else if (c == '<') {
            safe += "&lt;";
        } else if (c == '>') {
            safe += "&gt;";
        } else if (c == '"') {
            safe += "&quot;";
        } else {
            safe += c;
        }
    }
    return safe;
}

[[nodiscard]] inline std::string write(double x, double y, std::string_view attributes, std::string_view text) {
    return formatted("<text x=\"%.1f\" y=\"%.1f\" ", x, y) + std::string(attributes) + ">" + escaped(text) +
           "</text>\n";
}

// Writes text upwards, its middle at (x, y): the label of a y axis.
[[nodiscard]] inline std::string write_upright(double x, double y, std::string_view text) {
    return write(x, y, formatted("text-anchor=\"middle\" transform=\"rotate(-90 %.1f %.1f)\"", x, y), text);
}

// Draws a line from (x0, y0) to (x1, y1); attributes follow the colour.
[[nodiscard]] inline std::string line(double x0, double y0, double x1, double y1, const char* colour,
                                      const char* attributes = "") {
    return formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\"%s/>\n", x0, y0, x1, y1,
                     colour, attributes);
}

[[nodiscard]] inline std::string rectangle(double x, double y, double width, double height, const char* fill,
                                           const char* stroke) {
    return formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" stroke=\"%s\"/>\n", x, y,
                     width, height, fill, stroke);
}

// Draws grid lines down from (x, y) and to the right of it.
[[nodiscard]] inline std::string line_down(double x, double y, double length, const char* colour) {
    return formatted("<path d=\"M%.1f %.1f v%.1f\" stroke=\"%s\"/>\n", x, y, length, colour);
}
[[nodiscard]] inline std::string line_across(double x, double y, double length, const char* colour) {
    return formatted("<path d=\"M%.1f %.1f h%.1f\" stroke=\"%s\"/>\n", x, y, length, colour);
}

// Begins a figure on white, with its title at the height title_y; "</svg>\n" ends it.
[[nodiscard]] inline std::string svg_begin(double width, double height, std::string_view title, double title_y) {
    const std::string begin = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
        "font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"11\">\n"
        "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
        width, height, width, height);
    return begin + write(width / 2, title_y, "text-anchor=\"middle\" font-size=\"16\" font-weight=\"bold\"", title);
}

// Returns the least of 1, 2 and 5 times a power of ten that is not below `least`.
[[nodiscard]] inline double round_step(double least) {
    const double decade = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (least <= step * decade) return step * decade;
    }
    return 10.0 * decade;
}

}  // namespace burin::plot
