// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "desk/panel/panel_widgets.hpp"

namespace burin::session::panel {

namespace {

// Returns the next of 1, 1.5, 2, 3, 5, 7.5, 10, 15 ... : a scale that does not follow every value up and down.
float round_top(float most) {
    const float power = std::pow(10.0f, std::floor(std::log10(most)));
    for (const float step : {1.0f, 1.5f, 2.0f, 3.0f, 5.0f, 7.5f}) {
        if (most <= step * power) return step * power;
    }
    return 10.0f * power;
}

// Reduces values to at most `most` points, each the largest of those it stands for, so that no peak is lost.
std::vector<float> peaks(const std::vector<float>& values, std::size_t most) {
    if (values.size() <= most) return values;
    std::vector<float> kept(most, 0.0f);
    for (std::size_t i = 0; i < values.size(); ++i) {
        float& peak = kept[i * most / values.size()];
        peak = std::max(peak, values[i]);
    }
    return kept;
}

// Returns the top of the scale. A distant limit would flatten the curve: it is included when the values come near it.
float top_of(const std::vector<float>& values, float limit, float least_top) {
    constexpr float kNear = 0.25f;
    float top = least_top;
    for (const float v : values) top = std::max(top, std::isfinite(v) ? v : 0.0f);
    if (top >= kNear * limit) top = std::max(top, 1.05f * limit);
    return round_top(top);
}

}  // namespace

void Kit::plot(std::string_view title, std::string_view value, const PanelPlot& plot, ImU32 colour, float least_top,
               float whole) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float caption = px(18.0f), height = px(38.0f);
    ImGui::Dummy({whole, caption + height});
    write(at, kDim, title, type.small);
    write_right(at.x + whole, at.y, kText, value, type.small);
    const ImVec2 lo{at.x, at.y + caption}, hi{at.x + whole, at.y + caption + height};
    draw.AddRectFilled(lo, hi, kField, px(5.0f));
    const std::vector<float> values = peaks(plot.values, static_cast<std::size_t>(whole / px(1.5f)));
    const float top = top_of(values, plot.limit, least_top);
    const float inset = px(3.0f), left = lo.x + inset, right = hi.x - inset, floor = hi.y - inset;
    const auto y_of = [&](float v) {
        return floor - (std::isfinite(v) ? std::clamp(v / top, 0.0f, 1.0f) : 0.0f) * (height - 2.0f * inset);
    };
    const std::string scale = written("%g", double{top});
    // Begins the limit's line beside the scale's text, where it would cross it.
    const float name = y_of(plot.limit) < lo.y + px(16.0f) ? size_of(scale, type.small).x + px(7.0f) : 0.0f;
    if (plot.limit > 0.0f && plot.limit <= top)
        draw.AddLine({left + name, y_of(plot.limit)}, {right, y_of(plot.limit)}, with_alpha(kWarning, 110), px(1.0f));
    if (values.size() >= 2) {
        std::vector<ImVec2> line;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const float x = left + (right - left) * static_cast<float>(i) / static_cast<float>(values.size() - 1);
            line.push_back({x, y_of(values[i])});
        }
        for (std::size_t i = 1; i < line.size(); ++i) {
            draw.AddQuadFilled(line[i - 1], line[i], {line[i].x, floor}, {line[i - 1].x, floor},
                               with_alpha(colour, 46));
        }
        draw.AddPolyline(line.data(), static_cast<int>(line.size()), colour, 0, px(1.4f));
    }
    write({left + px(3.0f), lo.y + px(2.0f)}, with_alpha(kDim, 150), scale, type.small);
}

}  // namespace burin::session::panel
