// SPDX-License-Identifier: MIT
#include "desk/panel/panel_widgets.hpp"

#include "session/state/command_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace burin::session::panel {

namespace {

ImDrawList& draw() { return *ImGui::GetWindowDrawList(); }

ImVec2 operator+(ImVec2 a, ImVec2 b) { return {a.x + b.x, a.y + b.y}; }

// Corners and state of an area that can be pressed; the caller draws it.
struct Pressed {
    ImVec2 lo, hi;
    bool clicked, hovered, held;
};
Pressed press_area(const char* id, ImVec2 size) {
    const bool clicked = ImGui::InvisibleButton(id, size);
    return {ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), clicked, ImGui::IsItemHovered(), ImGui::IsItemActive()};
}

const char* end_of(std::string_view text) { return text.data() + text.size(); }

}  // namespace

ImU32 colour_of(Condition condition) {
    switch (condition) {
        case Condition::good: return kGood;
        case Condition::idle: return kFaint;
        case Condition::warning: return kWarning;
        case Condition::fault: return kFault;
    }
    return kFaint;
}

double part_of(double value, double from, double to, bool by_ratio) {
    if (by_ratio) return value > 0.0 ? std::clamp(std::log(value / from) / std::log(to / from), 0.0, 1.0) : 0.0;
    return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

double value_at(double part, double from, double to, bool by_ratio) {
    if (by_ratio) return std::clamp(rounded(from * std::pow(to / from, part), 2), from, to);
    // Rounds to half a power of ten that lies between a thousandth and a hundredth of the range.
    const double step = 0.5 * std::pow(10.0, std::floor(std::log10((to - from) / 50.0)));
    return std::clamp(rounded(std::round((from + part * (to - from)) / step) * step, 6), from, to);
}

double rounded(double value, int digits) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return std::strtod(text.data(), nullptr);
}

std::string written(const char* format, double value) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

void Kit::give(const SessionCommand& command) { add(as_input(command)); }

void Kit::give_held(const SessionCommand& command) {
    CommandInput input = as_input(command);
    if (input == memory.last && for_hand.name == memory.last_for) return;
    memory.last = input;
    memory.last_for = for_hand.name;
    add(std::move(input));
}

void Kit::add(CommandInput input) {
    if (for_hand.name.empty()) return actions.push_back(std::move(input));
    actions.push_back(as_input(LeadHand{for_hand.name}));
    actions.push_back(std::move(input));
    actions.push_back(as_input(LeadHand{for_hand.in_use}));
}

void Kit::note(const std::string& label) {
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const float x0 = std::max(lo.x, visible_lo.x), y0 = std::max(lo.y, visible_lo.y);
    const float x1 = std::min(hi.x, visible_hi.x), y1 = std::min(hi.y, visible_hi.y);
    if (x1 - x0 < 2.0f || y1 - y0 < 2.0f) return;  // scrolled away
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) hovered = label;
    if (!off_because.empty()) why_off[label] = off_because;
    places[label] = {static_cast<std::uint32_t>(x0), static_cast<std::uint32_t>(y0),
                     static_cast<std::uint32_t>(x1 - x0), static_cast<std::uint32_t>(y1 - y0)};
}

ImVec2 Kit::size_of(std::string_view text, ImFont* font) const {
    ImFont* const f = font != nullptr ? font : type.text;
    return f->CalcTextSizeA(f->FontSize, 1e6f, 0.0f, text.data(), end_of(text));
}

float Kit::write(ImVec2 at, ImU32 colour, std::string_view text, ImFont* font) {
    ImFont* const f = font != nullptr ? font : type.text;
    draw().AddText(f, f->FontSize, {std::floor(at.x), std::floor(at.y)}, colour, text.data(), end_of(text));
    return size_of(text, f).x;
}

void Kit::write_right(float right, float top, ImU32 colour, std::string_view text, ImFont* font) {
    write({right - size_of(text, font).x, top}, colour, text, font);
}

void Kit::write_middle(ImVec2 lo, ImVec2 hi, ImU32 colour, std::string_view text, ImFont* font) {
    const ImVec2 size = size_of(text, font);
    write({0.5f * (lo.x + hi.x - size.x), 0.5f * (lo.y + hi.y - size.y)}, colour, text, font);
}

std::string Kit::shortened(std::string_view text, float room, ImFont* font) const {
    if (size_of(text, font).x <= room) return std::string(text);
    constexpr std::string_view kEllipsis = "...";
    while (!text.empty() && size_of(std::string(text) + std::string(kEllipsis), font).x > room) {
        text.remove_suffix(1);
        // Do not cut in the middle of a UTF-8 character.
        while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.remove_suffix(1);
        if (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0xC0) text.remove_suffix(1);
    }
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return std::string(text) + std::string(kEllipsis);
}

void Kit::paragraph(ImU32 colour, std::string_view text, ImFont* font) {
    ImGui::PushFont(font != nullptr ? font : type.small);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width());
    ImGui::TextUnformatted(text.data(), end_of(text));
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void Kit::gap(float height) { ImGui::Dummy({1.0f, std::max(0.0f, px(height) - ImGui::GetStyle().ItemSpacing.y)}); }

float Kit::width() const { return ImGui::GetContentRegionAvail().x - px(12.0f); }

// Begins a card. Its background is drawn below its contents once its height is known.
bool Kit::begin_card(const char* title, std::string_view aside) {
    draw().ChannelsSplit(2);
    draw().ChannelsSetCurrent(1);
    card_top = ImGui::GetCursorScreenPos().y;
    const Pressed head = press_area(title, {ImGui::GetContentRegionAvail().x, px(30.0f)});
    note(title);
    const auto at = std::ranges::find(memory.closed, title);
    bool open = at == memory.closed.end();
    if (head.clicked && open) memory.closed.emplace_back(title);
    if (head.clicked && !open) memory.closed.erase(at);
    if (head.clicked) open = !open;
    const float middle = 0.5f * (head.lo.y + head.hi.y) + px(1.0f), r = px(3.2f), x = head.hi.x - px(16.0f);
    const ImU32 colour = head.hovered ? kText : kDim;
    const std::array<ImVec2, 3> chevron =
        open ? std::array<ImVec2, 3>{ImVec2{x - r, middle - 0.5f * r},
                                     {x, middle + 0.5f * r},
                                     {x + r, middle - 0.5f * r}}
             : std::array<ImVec2, 3>{
                   ImVec2{x - 0.5f * r, middle - r}, {x + 0.5f * r, middle}, {x - 0.5f * r, middle + r}};
    draw().AddPolyline(chevron.data(), 3, colour, 0, px(1.5f));
    const float name = write({head.lo.x + px(12.0f), middle - px(9.0f)}, kText, title, type.strong);
    const float room = x - px(10.0f) - (head.lo.x + px(12.0f) + name + px(12.0f));
    if (!aside.empty())
        write_right(x - px(10.0f), middle - px(8.0f), kDim, shortened(aside, room, type.small), type.small);
    ImGui::Indent(px(12.0f));
    return open;
}

void Kit::end_card() {
    ImGui::Unindent(px(12.0f));
    const float bottom = ImGui::GetCursorScreenPos().y + px(3.0f);
    const float left = ImGui::GetCursorScreenPos().x;
    draw().ChannelsSetCurrent(0);
    draw().AddRectFilled({left, card_top}, {left + ImGui::GetContentRegionAvail().x, bottom}, kCard, px(7.0f));
    draw().ChannelsMerge();
    ImGui::Dummy({1.0f, px(5.0f)});
}

std::optional<std::size_t> Kit::segments(std::span<const Item> items, std::size_t selected, float height) {
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float whole = width(), each = whole / static_cast<float>(items.size());
    draw().AddRectFilled(start, start + ImVec2{whole, px(height)}, kField, px(6.0f));
    std::optional<std::size_t> chosen;
    for (std::size_t i = 0; i < items.size(); ++i) {
        ImGui::SetCursorScreenPos(start + ImVec2{each * static_cast<float>(i), 0.0f});
        const Pressed p = press_area(items[i].label.c_str(), {each, px(height)});
        note(items[i].label);
        const bool enabled = items[i].enabled && off_because.empty();
        if (p.clicked && enabled) chosen = i;
        const float inset = px(2.0f);
        const ImVec2 lo = p.lo + ImVec2{inset, inset}, hi = p.hi + ImVec2{-inset, -inset};
        const bool on = i == selected;
        if (on) draw().AddRectFilled(lo, hi, !enabled ? kControl : p.hovered ? kAccentHovered : kAccent, px(5.0f));
        if (!on && p.hovered && enabled) draw().AddRectFilled(lo, hi, kControl, px(5.0f));
        const ImU32 colour = !enabled ? kFaint : on ? kOnAccent : p.hovered ? kText : kDim;
        if (!items[i].text.empty()) write_middle(lo, hi, colour, items[i].text, on ? type.strong : nullptr);
    }
    return chosen;
}

std::optional<double> Kit::slider(const std::string& label, std::string_view title, double part,
                                  std::string_view value) {
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float whole = width(), height = px(24.0f), name = px(92.0f), number = px(94.0f), knob = px(6.0f);
    const float middle = start.y + 0.5f * height;
    const bool on = off_because.empty();
    write({start.x, middle - 0.5f * type.text->FontSize}, on ? kDim : kFaint, title);
    ImGui::SetCursorScreenPos({start.x + name, start.y});
    Pressed p = press_area(label.c_str(), {whole - name - number, height});
    note(label);
    p.held = p.held && on;
    p.hovered = p.hovered && on;
    const float x0 = p.lo.x + knob, x1 = p.hi.x - knob;
    std::optional<double> moved;
    if (p.held) moved = std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - x0) / (x1 - x0)), 0.0, 1.0);
    if (p.held && ImGui::IsMouseClicked(0)) memory.last = {};
    const float at = x0 + static_cast<float>(moved.value_or(part)) * (x1 - x0), half = px(2.0f);
    draw().AddRectFilled({x0 - half, middle - half}, {x1 + half, middle + half}, kField, half);
    draw().AddRectFilled({x0 - half, middle - half}, {at, middle + half}, on ? kAccent : kControl, half);
    draw().AddCircleFilled({at, middle}, p.held || p.hovered ? knob : 0.85f * knob,
                           !on                   ? kFaint
                           : p.held || p.hovered ? kText
                                                 : IM_COL32(204, 208, 212, 255),
                           24);
    write_right(start.x + whole, middle - 0.5f * type.text->FontSize, on ? kText : kFaint, value);
    return moved;
}

void Kit::quantity(Quantity quantity, std::string_view title, double value, std::string_view text) {
    const QuantityDescriptor& range = descriptor_of(quantity);
    const auto part = slider(std::string(range.name) + (for_hand.name.empty() ? "" : " " + for_hand.name), title,
                             part_of(value, range.from, range.to, range.by_ratio), text);
    if (!part) return;
    // A quantity that may be none is none at the slider's left end.
    const bool none = *part <= 0.0 && quantity == Quantity::hardness;
    const double wanted = none ? 0.0 : value_at(*part, range.from, range.to, range.by_ratio);
    if (wanted != value) give_held(SetQuantity{quantity, wanted});
}

bool Kit::toggle(const std::string& label, std::string_view title, bool on, std::string_view aside) {
    const float height = px(25.0f);
    const Pressed p = press_area(label.c_str(), {width(), height});
    note(label);
    const bool can = off_because.empty();
    const float middle = 0.5f * (p.lo.y + p.hi.y), r = px(8.0f), right = p.hi.x;
    write({p.lo.x, middle - 0.5f * type.text->FontSize}, can ? kDim : kFaint, title);
    const ImU32 ground = !can ? kField
                         : on ? (p.hovered ? kAccentHovered : kAccent)
                              : (p.hovered ? kControlHovered : kControl);
    draw().AddRectFilled({right - 3.8f * r, middle - r}, {right, middle + r}, ground, r);
    draw().AddCircleFilled({on ? right - r : right - 2.8f * r, middle}, 0.7f * r,
                           !can ? kFaint
                           : on ? kOnAccent
                                : kText,
                           20);
    if (!aside.empty()) write_right(right - 4.6f * r, middle - 0.5f * type.small->FontSize, kDim, aside, type.small);
    return p.clicked && can;
}

std::optional<std::size_t> Kit::list(const std::string& label, std::string_view title, std::span<const Item> items,
                                     std::size_t selected) {
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float name = px(92.0f), height = px(28.0f), row = px(26.0f);
    const float middle = start.y + 0.5f * height;
    const bool on = off_because.empty();
    write({start.x, middle - 0.5f * type.text->FontSize}, on ? kDim : kFaint, title);
    ImGui::SetCursorScreenPos({start.x + name, start.y});
    Pressed p = press_area(label.c_str(), {width() - 0.0f, height});
    note(label);
    p.clicked = p.clicked && on;
    p.hovered = p.hovered && on;
    draw().AddRectFilled(p.lo, p.hi, !on ? kField : p.hovered ? kControlHovered : kControl, px(6.0f));
    draw().PushClipRect(p.lo, {p.hi.x - px(20.0f), p.hi.y}, true);
    if (selected < items.size())
        write({p.lo.x + px(10.0f), middle - 0.5f * type.text->FontSize}, on ? kText : kFaint, items[selected].text);
    draw().PopClipRect();
    const float x = p.hi.x - px(14.0f), r = px(3.2f);
    const std::array<ImVec2, 3> chevron{
        ImVec2{x - r, middle - 0.5f * r}, {x, middle + 0.5f * r}, {x + r, middle - 0.5f * r}};
    draw().AddPolyline(chevron.data(), 3, on ? kDim : kFaint, 0, px(1.5f));

    const std::string popup = label + " list";
    if (p.clicked) ImGui::OpenPopup(popup.c_str());
    again = again || p.clicked;
    const float tall = row * static_cast<float>(items.size()) + px(8.0f), wide = px(220.0f);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float top =
        p.hi.y + px(3.0f) + tall <= screen.y ? p.hi.y + px(3.0f) : std::max(0.0f, p.lo.y - px(3.0f) - tall);
    ImGui::SetNextWindowPos({p.hi.x - wide, std::min(top, std::max(0.0f, screen.y - tall))});
    ImGui::SetNextWindowSize({wide, tall});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(4.0f), px(4.0f)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.0f});
    std::optional<std::size_t> chosen;
    if (ImGui::BeginPopup(popup.c_str(), ImGuiWindowFlags_NoMove)) {
        const ImVec2 lo = visible_lo, hi = visible_hi;
        visible_lo = {0.0f, 0.0f};
        visible_hi = screen;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const Pressed line = press_area(items[i].label.c_str(), {wide - px(8.0f), row});
            note(items[i].label);
            if (line.hovered) draw().AddRectFilled(line.lo, line.hi, kControl, px(4.0f));
            write({line.lo.x + px(10.0f), line.lo.y + 0.5f * (row - type.text->FontSize)},
                  i == selected ? kAccent : kText, items[i].text, i == selected ? type.strong : nullptr);
            if (line.clicked) {
                chosen = i;
                ImGui::CloseCurrentPopup();
            }
        }
        visible_lo = lo;
        visible_hi = hi;
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
    return chosen;
}

bool Kit::button(const std::string& label, std::string_view text, float wide, bool enabled, bool strong, float height) {
    const Pressed p = press_area(label.c_str(), {wide, px(height)});
    note(label);
    enabled = enabled && off_because.empty();
    const ImU32 plain = strong ? kAccent : kControl, hovered = strong ? kAccentHovered : kControlHovered;
    draw().AddRectFilled(p.lo, p.hi, !enabled ? with_alpha(kControl, 90) : p.hovered ? hovered : plain, px(6.0f));
    write_middle(p.lo, p.hi, !enabled ? kFaint : strong ? kOnAccent : kText, text, strong ? type.strong : nullptr);
    return p.clicked && enabled;
}

void Kit::figure(std::string_view name, std::string_view value, ImU32 colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float whole = width();
    ImGui::Dummy({whole, px(17.0f)});
    write(at, kDim, name, type.small);
    write_right(at.x + whole, at.y, colour, value, type.small);
}

void Kit::lamp(ImVec2 middle, Condition condition) {
    draw().AddCircleFilled(middle, px(7.0f), with_alpha(colour_of(condition), 50), 20);
    draw().AddCircleFilled(middle, px(4.0f), colour_of(condition), 16);
}

}  // namespace burin::session::panel
