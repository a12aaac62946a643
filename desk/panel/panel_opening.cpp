// SPDX-License-Identifier: MIT
// The card of what is opened: its name, the step that goes on, the share that is done, and the seconds so far.
#include <algorithm>
#include <cmath>

#include "desk/panel/panel_sections.hpp"

namespace burin::session::panel {
namespace {

constexpr float kOpeningWidth = 420.0f, kOpeningHeight = 112.0f, kOpeningInset = 18.0f;
constexpr const char* kOpeningHint = "Esc or closing the window ends this";

}  // namespace

void show_opening(Kit& kit, const PanelOpening& opening, const Area& free) {
    const float inset = kit.px(kOpeningInset), most = free.hi.x - free.lo.x - 2.0f * inset;
    const ImVec2 size{std::min(kit.px(kOpeningWidth), most), kit.px(kOpeningHeight)};
    if (size.x <= 0.0f || size.y + 2.0f * inset > free.hi.y - free.lo.y) return;
    const ImVec2 lo{std::floor(free.lo.x + 0.5f * (free.hi.x - free.lo.x - size.x)),
                    std::floor(free.hi.y - size.y - inset)};
    const ImVec2 hi{lo.x + size.x, lo.y + size.y};
    ImGui::SetNextWindowPos(lo);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin("opening", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImDrawList& d = *ImGui::GetWindowDrawList();
    d.AddRectFilled(lo, hi, with_alpha(kGround, 246), kit.px(10.0f));
    const std::string seconds = std::to_string(opening.seconds) + " s";
    const float left = lo.x + inset, right = hi.x - inset, beside = kit.size_of(seconds).x + inset;
    kit.write({left, lo.y + kit.px(12.0f)}, kText, kit.shortened(opening.name, right - left, kit.type.title),
              kit.type.title);
    kit.write({left, lo.y + kit.px(44.0f)}, kDim, kit.shortened(opening.step, right - left - beside));
    kit.write_right(right, lo.y + kit.px(44.0f), kDim, seconds);
    const ImVec2 from{left, lo.y + kit.px(68.0f)}, to{right, lo.y + kit.px(74.0f)};
    const float done = static_cast<float>(std::clamp(opening.percent, 0, 100)) / 100.0f;
    d.AddRectFilled(from, to, kControl, kit.px(3.0f));
    if (done > 0.0f) d.AddRectFilled(from, {from.x + done * (to.x - from.x), to.y}, kAccent, kit.px(3.0f));
    kit.write({left, lo.y + kit.px(84.0f)}, kFaint, kOpeningHint, kit.type.small);
    kit.write_right(right, lo.y + kit.px(84.0f), kDim, std::to_string(opening.percent) + " %", kit.type.small);
    ImGui::End();
    kit.parts.push_back({static_cast<std::uint32_t>(lo.x), static_cast<std::uint32_t>(lo.y),
                         static_cast<std::uint32_t>(size.x) + 1, static_cast<std::uint32_t>(size.y) + 1});
    kit.places["opening"] = kit.parts.back();
}

}  // namespace burin::session::panel
