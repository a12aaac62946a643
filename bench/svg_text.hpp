// SPDX-License-Identifier: MIT
// What the figures' writers share: colours, numbers in text, and text that is safe in SVG.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace burin::bench {

// Okabe and Ito's colours, which people with any kind of colour vision tell apart.
inline constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"};

std::string text_of(const char* format, auto... values) {
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

inline std::string escaped(const std::string& text) {
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

inline std::string write(double x, double y, const char* attributes, const std::string& text) {
    return text_of("<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, attributes) + escaped(text) + "</text>\n";
}

// The beginning of a figure on white, with its title.
inline std::string svg_begin(double width, double height, const std::string& title) {
    const std::string begin = text_of(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
        "font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"11\">\n"
        "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
        width, height, width, height);
    return begin + write(width / 2, 30, "text-anchor=\"middle\" font-size=\"16\" font-weight=\"bold\"", title);
}

}  // namespace burin::bench
