// SPDX-License-Identifier: MIT
// Colours to choose from: of the panel's own sections and of an activity's.
#include <algorithm>
#include <array>

#include "desk/panel/panel_sections.hpp"

namespace burin::session::panel {
namespace {

constexpr std::array<std::array<double, 3>, 8> kSwatches{{{0.80, 0.76, 0.70},
                                                          {0.88, 0.56, 0.21},
                                                          {0.70, 0.34, 0.22},
                                                          {0.62, 0.22, 0.30},
                                                          {0.38, 0.62, 0.48},
                                                          {0.26, 0.41, 0.77},
                                                          {0.44, 0.38, 0.64},
                                                          {0.36, 0.38, 0.40}}};

ImU32 packed(const std::array<double, 3>& srgb) {
    return ImGui::ColorConvertFloat4ToU32(
        {static_cast<float>(srgb[0]), static_cast<float>(srgb[1]), static_cast<float>(srgb[2]), 1.0f});
}

// Draws the swatches of one row, side by side.
class SwatchRow {
public:
    SwatchRow(Kit& kit, std::string label, std::size_t count)
        : kit_(kit),
          label_(std::move(label)),
          start_(ImGui::GetCursorScreenPos()),
          each_(kit.width() / static_cast<float>(count)),
          radius_(std::min(kit.px(9.5f), 0.36f * each_)) {}

    // Each returns whether it was pressed. The row's own label is that of the colour which is none of the others.
    bool offered(std::size_t i, const std::array<double, 3>& srgb, bool chosen) {
        const Placed at = place(i, label_ + " " + std::to_string(i + 1));
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        if (chosen) draw.AddCircle(at.middle, radius_ + kit_.px(3.0f), at.can ? kText : kFaint, 32, kit_.px(1.5f));
        draw.AddCircleFilled(at.middle, at.hovered ? radius_ + kit_.px(1.0f) : radius_,
                             at.can ? packed(srgb) : with_alpha(packed(srgb), 90), 32);
        return at.clicked;
    }
    bool own(std::size_t i, const std::array<double, 3>& srgb) {
        const Placed at = place(i, label_);
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        const ImVec2 lo{at.middle.x - radius_, at.middle.y - radius_}, hi{at.middle.x + radius_, at.middle.y + radius_};
        draw.AddRectFilled(lo, hi, packed(srgb), kit_.px(4.0f));
        draw.AddRect(lo, hi, at.hovered ? kText : kDim, kit_.px(4.0f), 0, kit_.px(1.2f));
        return at.clicked;
    }

private:
    struct Placed {
        ImVec2 middle;
        bool clicked, hovered, can;
    };
    Placed place(std::size_t i, const std::string& label) {
        const float height = kit_.px(30.0f);
        ImGui::SetCursorScreenPos({start_.x + each_ * static_cast<float>(i), start_.y});
        const bool clicked = ImGui::InvisibleButton(label.c_str(), {each_, height});
        kit_.note(label);
        const bool can = kit_.off_because.empty();
        const ImVec2 middle{start_.x + each_ * (static_cast<float>(i) + 0.5f), start_.y + 0.5f * height};
        return {middle, clicked && can, ImGui::IsItemHovered() && can, can};
    }

    Kit& kit_;
    std::string label_;
    ImVec2 start_;
    float each_, radius_;
};

}  // namespace

void show_swatches(Kit& kit, const std::string& label, const OfferedColours& offered,
                   const std::function<void(const std::array<double, 3>&)>& give) {
    SwatchRow row(kit, label, offered.srgb.size());
    for (std::size_t i = 0; i < offered.srgb.size(); ++i)
        if (row.offered(i, offered.srgb[i], i == offered.chosen) && i != offered.chosen) give(offered.srgb[i]);
}

void show_swatches(Kit& kit, const std::string& label, const std::array<double, 3>& now_srgb,
                   const std::function<void(const std::array<double, 3>&)>& give) {
    SwatchRow row(kit, label, kSwatches.size() + 1);
    for (std::size_t i = 0; i < kSwatches.size(); ++i)
        if (row.offered(i, kSwatches[i], kSwatches[i] == now_srgb)) give(kSwatches[i]);
    if (row.own(kSwatches.size(), now_srgb)) {
        ImGui::OpenPopup((label + " circle").c_str());
        kit.again = true;
    }
    const ImVec2 corner = ImGui::GetItemRectMax();
    const float wide = kit.px(236.0f), tall = kit.px(216.0f);
    ImGui::SetNextWindowPos(
        {corner.x - wide, std::max(0.0f, std::min(corner.y + kit.px(4.0f), ImGui::GetIO().DisplaySize.y - tall))});
    ImGui::SetNextWindowSize({wide, tall});
    if (!ImGui::BeginPopup((label + " circle").c_str(), ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoScrollbar)) return;
    std::array<float, 3> parts{};
    for (std::size_t k = 0; k < 3; ++k) parts[k] = static_cast<float>(now_srgb[k]);
    ImGui::SetNextItemWidth(wide - kit.px(16.0f));
    if (ImGui::ColorPicker3("##circle", parts.data(),
                            ImGuiColorEditFlags_PickerHueWheel | ImGuiColorEditFlags_NoInputs |
                                ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoOptions |
                                ImGuiColorEditFlags_NoAlpha)) {
        std::array<double, 3> srgb{};
        for (std::size_t k = 0; k < 3; ++k) srgb.at(k) = rounded(std::clamp(double{parts[k]}, 0.0, 1.0), 3);
        give(srgb);
    }
    ImGui::EndPopup();
}

}  // namespace burin::session::panel
