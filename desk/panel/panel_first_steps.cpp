// SPDX-License-Identifier: MIT
// The card for who sees the program for the first time: what the mouse does, in four small pictures. It takes no mouse,
// so that the first press already works. It lies at the picture's lower end, where it hides the plinth rather than the
// part.
#include <algorithm>
#include <cmath>

#include "desk/panel/panel_sections.hpp"

namespace burin::session::panel {
namespace {

constexpr float kStepWidth = 138.0f, kCardHeight = 218.0f, kCardInset = 18.0f;
constexpr ImU32 kClay = IM_COL32(190, 178, 160, 255), kClayDark = IM_COL32(146, 134, 117, 255);

// Draws in a square of 100 units around a middle.
struct Sketch {
    ImDrawList& list;
    ImVec2 middle;
    float unit;

    [[nodiscard]] ImVec2 at(float x, float y) const { return {middle.x + unit * x, middle.y + unit * y}; }
    void disc(float x, float y, float r, ImU32 colour) const { list.AddCircleFilled(at(x, y), unit * r, colour, 48); }
    void line(std::initializer_list<ImVec2> points, ImU32 colour, float width) const {
        std::vector<ImVec2> placed;
        for (const ImVec2& p : points) placed.push_back(at(p.x, p.y));
        list.AddPolyline(placed.data(), static_cast<int>(placed.size()), colour, 0, unit * width);
    }
    // The part of a ring from one angle to another, with an arrow's head at its end; degrees, clockwise from the right.
    void arrow_around(float x, float y, float r, float from_deg, float to_deg, ImU32 colour) const {
        constexpr float kPerDegree = 3.14159265f / 180.0f;
        constexpr int kSegments = 24;
        std::vector<ImVec2> arc;
        for (int i = 0; i <= kSegments; ++i) {
            const float a = kPerDegree * (from_deg + (to_deg - from_deg) * static_cast<float>(i) / kSegments);
            arc.push_back(at(x + r * std::cos(a), y + r * std::sin(a)));
        }
        list.AddPolyline(arc.data(), static_cast<int>(arc.size()), colour, 0, unit * 4.0f);
        const float end = kPerDegree * to_deg, turn = to_deg > from_deg ? 1.0f : -1.0f;
        const ImVec2 along{-std::sin(end) * turn, std::cos(end) * turn}, out{std::cos(end), std::sin(end)};
        const ImVec2 tip{x + r * out.x + 10.0f * along.x, y + r * out.y + 10.0f * along.y};
        list.AddTriangleFilled(at(tip.x, tip.y), at(x + (r - 8.0f) * out.x, y + (r - 8.0f) * out.y),
                               at(x + (r + 8.0f) * out.x, y + (r + 8.0f) * out.y), colour);
    }
    void workpiece() const {
        disc(0.0f, 4.0f, 34.0f, kClayDark);
        disc(-2.0f, 2.0f, 31.0f, kClay);
    }
    void pointer(float x, float y) const {
        const ImVec2 tip = at(x, y), left = at(x, y + 24.0f), inner = at(x + 6.0f, y + 18.5f),
                     right = at(x + 17.0f, y + 17.0f);
        list.AddTriangleFilled(tip, left, inner, kText);
        list.AddTriangleFilled(tip, inner, right, kText);
    }
    // A mouse, one of whose buttons is pressed: 0 left, 1 right; none: -1.
    void mouse(float x, float y, int pressed) const {
        const ImVec2 lo = at(x - 13.0f, y - 18.0f), hi = at(x + 13.0f, y + 20.0f), top = at(x, y - 18.0f);
        list.AddRectFilled(lo, hi, kControl, unit * 12.0f);
        const float button = unit * 17.0f;
        if (pressed == 0)
            list.AddRectFilled(lo, {top.x, lo.y + button}, kAccent, unit * 12.0f, ImDrawFlags_RoundCornersTopLeft);
        if (pressed == 1)
            list.AddRectFilled(top, {hi.x, lo.y + button}, kAccent, unit * 12.0f, ImDrawFlags_RoundCornersTopRight);
        list.AddRect(lo, hi, kDim, unit * 12.0f, 0, unit * 2.0f);
        list.AddLine({lo.x, lo.y + button}, {hi.x, lo.y + button}, kDim, unit * 2.0f);
        list.AddLine(top, {top.x, lo.y + button}, kDim, unit * 2.0f);
    }
};

void draw_move(const Sketch& s) {
    s.workpiece();
    s.disc(-9.0f, -14.0f, 8.0f, kAccent);
    s.line({{12.0f, -38.0f}, {-9.0f, -14.0f}}, kAccent, 4.0f);
    s.pointer(-9.0f, -14.0f);
    s.mouse(36.0f, 26.0f, -1);
}

void draw_press(const Sketch& s) {
    s.workpiece();
    s.line({{-24.0f, 14.0f}, {-12.0f, -4.0f}, {2.0f, 6.0f}, {14.0f, -12.0f}}, kClayDark, 9.0f);
    s.disc(-24.0f, 14.0f, 4.5f, kClayDark);
    s.disc(14.0f, -12.0f, 8.0f, kAccent);
    s.line({{32.0f, -36.0f}, {14.0f, -12.0f}}, kAccent, 4.0f);
    s.mouse(36.0f, 26.0f, 0);
}

void draw_turn(const Sketch& s) {
    s.workpiece();
    s.line({{-2.0f, -28.0f}, {-12.0f, 2.0f}, {-2.0f, 32.0f}}, kClayDark, 2.5f);
    s.arrow_around(0.0f, 4.0f, 42.0f, 215.0f, 320.0f, kAccent);
    s.mouse(36.0f, 26.0f, 1);
}

void draw_undo(const Sketch& s) {
    s.workpiece();
    s.arrow_around(0.0f, 2.0f, 16.0f, 40.0f, -205.0f, kGround | IM_COL32_A_MASK);
}

struct FirstStep {
    const char *title, *text;
    void (*draw)(const Sketch&);
};
constexpr std::array<FirstStep, 4> kFirstSteps{
    {{"Move", "The tool is where the cursor is on the part.", draw_move},
     {"Press and drag", "The left button works; the wheel meanwhile sets how deep.", draw_press},
     {"Turn", "Drag with the right button, or beside the part. The wheel zooms.", draw_turn},
     {"Undo", "Ctrl+Z takes a stroke back. F1 lists all keys.", draw_undo}}};

}  // namespace

void show_first_steps(Kit& kit, const PanelModel&, const Area& free) {
    const float inset = kit.px(kCardInset), step = kit.px(kStepWidth);
    const ImVec2 room{free.hi.x - free.lo.x, free.hi.y - free.lo.y};
    const bool in_a_row = room.x >= 4.0f * step + 2.0f * inset;
    const int across = in_a_row ? 4 : 2;
    const float row = kit.px(kCardHeight - 62.0f);
    const ImVec2 size{static_cast<float>(across) * step + 2.0f * inset,
                      kit.px(62.0f) + row * static_cast<float>(4 / across)};
    if (size.x > room.x || size.y > room.y) return;
    const ImVec2 lo{std::floor(free.lo.x + 0.5f * (room.x - size.x)),
                    std::floor(free.hi.y - std::min(size.y + kit.px(14.0f), room.y))};
    ImGui::SetNextWindowPos(lo);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin("first-steps", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar();
    ImDrawList& d = *ImGui::GetWindowDrawList();
    d.AddRectFilled(lo, {lo.x + size.x, lo.y + size.y}, with_alpha(kGround, 246), kit.px(10.0f));
    kit.write({lo.x + inset, lo.y + kit.px(12.0f)}, kText, "First steps", kit.type.title);
    kit.write_right(lo.x + size.x - inset, lo.y + kit.px(18.0f), kDim, "a click or Esc closes this", kit.type.small);
    for (std::size_t i = 0; i < kFirstSteps.size(); ++i) {
        const FirstStep& one = kFirstSteps.at(i);
        const auto column = static_cast<float>(i % static_cast<std::size_t>(across));
        const auto line = static_cast<float>(i / static_cast<std::size_t>(across));
        const ImVec2 at{lo.x + inset + column * step, lo.y + kit.px(48.0f) + line * row};
        one.draw({d, {at.x + 0.5f * step, at.y + kit.px(42.0f)}, kit.px(0.86f)});
        const float wide = step - kit.px(10.0f);
        const std::string title = one.title, text = one.text;
        const float left = at.x + 0.5f * (step - kit.size_of(title, kit.type.strong).x);
        kit.write({left, at.y + kit.px(88.0f)}, kAccent, title, kit.type.strong);
        d.AddText(kit.type.small, kit.type.small->FontSize, {at.x + kit.px(5.0f), at.y + kit.px(108.0f)}, kText,
                  text.data(), text.data() + text.size(), wide);
    }
    ImGui::End();
    kit.parts.push_back({static_cast<std::uint32_t>(lo.x), static_cast<std::uint32_t>(lo.y),
                         static_cast<std::uint32_t>(size.x) + 1, static_cast<std::uint32_t>(size.y) + 1});
    kit.places["first-steps"] = kit.parts.back();
}

}  // namespace burin::session::panel
