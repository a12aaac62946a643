// SPDX-License-Identifier: MIT
// What a person is doing now, large over the picture: what comes next, how long a force is still to be held, and a bar
// for each force against what is asked. And the tables for who leads the session.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "desk/panel/panel_sections.hpp"

namespace burin::session::panel {
namespace {

using Task = ActivityPanel::Task;

constexpr float kTaskInset = 16.0f, kTaskHeadline = 44.0f, kTaskBar = 26.0f, kTaskRing = 128.0f, kTaskLegend = 20.0f;
constexpr float kHeadlineGrows = 1.5f, kMostTask = 900.0f, kTaskName = 84.0f, kTaskNumber = 120.0f;

bool has_ring(const Task& task) { return task.hold_s > 0.0; }

ImU32 colour_of_bar(std::uint32_t srgb) { return IM_COL32((srgb >> 16) & 255, (srgb >> 8) & 255, srgb & 255, 255); }

float inside_height(const Task& task) {
    const float bars = task.bars.empty() ? 0.0f : kTaskBar * static_cast<float>(task.bars.size()) + kTaskLegend;
    return std::max(bars, has_ring(task) ? kTaskRing : 0.0f);
}

// Draws what comes next and how far it is; in a break, that.
void draw_headline(Kit& kit, const Task& task, ImVec2 lo, ImVec2 hi) {
    ImDrawList& d = *ImGui::GetWindowDrawList();
    ImFont* const font = kit.type.title;
    const float progress = kit.size_of(task.progress, font).x;
    const bool stands = !task.state.empty();
    const std::string& text = stands ? task.state : task.next;
    const float room = hi.x - lo.x - progress - kit.px(16.0f), wanted = kit.size_of(text, font).x;
    const float size = font->FontSize * std::min(kHeadlineGrows, wanted > 0.0f ? room / wanted : 1.0f);
    d.AddText(font, size, lo, stands ? kWarning : kText, text.data(), text.data() + text.size());
    kit.write_right(hi.x, lo.y + kit.px(6.0f), kDim, task.progress, font);
}

// A ring that fills while the force is held, and the seconds that are left.
void draw_ring(Kit& kit, const Task& task, ImVec2 middle) {
    constexpr float kTop = -0.5f * std::numbers::pi_v<float>, kWhole = 2.0f * std::numbers::pi_v<float>;
    ImDrawList& d = *ImGui::GetWindowDrawList();
    const float radius = kit.px(0.42f * kTaskRing), thick = kit.px(12.0f);
    const auto part = static_cast<float>(std::clamp(task.held_s / task.hold_s, 0.0, 1.0));
    d.PathArcTo(middle, radius, kTop, kTop + kWhole, 64);
    d.PathStroke(kField, 0, thick);
    if (part > 0.0f) {
        d.PathArcTo(middle, radius, kTop, kTop + part * kWhole, 64);
        d.PathStroke(part < 1.0f ? kAccent : kGood, 0, thick);
    }
    const std::string left = written("%.1f s", std::max(task.hold_s - task.held_s, 0.0));
    const ImVec2 size = kit.size_of(left, kit.type.title);
    kit.write({middle.x - 0.5f * size.x, middle.y - 0.5f * size.y}, kText, left, kit.type.title);
}

void draw_bar(Kit& kit, const Task::Bar& bar, ImVec2 lo, float right) {
    ImDrawList& d = *ImGui::GetWindowDrawList();
    const float height = kit.px(kTaskBar - 8.0f), text = lo.y + 0.5f * (height - kit.type.strong->FontSize);
    kit.write({lo.x, text}, kText, bar.name, kit.type.strong);
    const float from = lo.x + kit.px(kTaskName), to = right - kit.px(kTaskNumber), length = std::max(to - from, 1.0f);
    const auto at = [&](double force_N) {
        return from + length * static_cast<float>(std::clamp(force_N / bar.full_N, 0.0, 1.0));
    };
    const ImU32 colour = colour_of_bar(bar.colour_srgb);
    const float half = lo.y + (bar.given_N ? 0.55f * height : height);
    d.AddRectFilled({from, lo.y}, {to, lo.y + height}, kField, kit.px(3.0f));
    d.AddRectFilled({from, lo.y}, {at(bar.asked_N), half}, colour);
    if (bar.given_N) d.AddRectFilled({from, half}, {at(*bar.given_N), lo.y + height}, with_alpha(colour, 150));
    d.AddRect({from, lo.y}, {to, lo.y + height}, kFaint, kit.px(3.0f));
    if (bar.target_N > 0.0) {
        const float x = at(bar.target_N), over = kit.px(3.0f);
        d.AddRectFilled({x - kit.px(1.5f), lo.y - over}, {x + kit.px(1.5f), lo.y + height + over}, kText);
    }
    const double now_N = bar.given_N.value_or(bar.asked_N);
    const bool reached = bar.target_N > 0.0 && now_N >= bar.target_N;
    const std::string number =
        written("%.1f", now_N) + (bar.target_N > 0.0 ? " of " + written("%.1f N", bar.target_N) : " N");
    kit.write({to + kit.px(10.0f), text}, reached ? kGood : kText, number, kit.type.strong);
}

}  // namespace

float task_height(const Kit& kit, const Task& task, float /*width*/) {
    return kit.px(kTaskHeadline + inside_height(task));
}

void draw_task(Kit& kit, const Task& task, ImVec2 lo, ImVec2 hi) {
    draw_headline(kit, task, lo, hi);
    const float top = lo.y + kit.px(kTaskHeadline);
    float left = lo.x;
    if (has_ring(task)) {
        const float ring = kit.px(kTaskRing);
        draw_ring(kit, task, {left + 0.5f * ring, top + 0.5f * ring});
        left += ring + kit.px(20.0f);
    }
    if (task.bars.empty()) return;
    float y = top;
    bool measured = false;
    for (const Task::Bar& bar : task.bars) {
        draw_bar(kit, bar, {left, y}, hi.x);
        y += kit.px(kTaskBar);
        measured = measured || bar.given_N.has_value();
    }
    kit.write({left + kit.px(kTaskName), y}, kDim,
              measured ? "upper half: asked of the glove; lower half: what it gives; line: what is asked of you"
                       : "bar: asked of the glove, which does not measure what it gives; line: what is asked of you",
              kit.type.small);
}

void show_task(Kit& kit, const Task& task, const Area& free) {
    const float margin = kit.px(14.0f), inset = kit.px(kTaskInset);
    const float room = free.hi.x - free.lo.x - 2.0f * margin;
    const float width = std::min(room, kit.px(kMostTask));
    const float height = task_height(kit, task, width - 2.0f * inset) + 2.0f * inset;
    if (width < kit.px(kTaskRing + kTaskName + kTaskNumber + 80.0f) || height > 0.6f * (free.hi.y - free.lo.y)) return;
    const ImVec2 lo{std::floor(free.lo.x + margin + 0.5f * (room - width)), std::floor(free.hi.y - margin - height)};
    const ImVec2 hi{lo.x + width, lo.y + height};
    ImGui::SetNextWindowPos(lo);
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin("task", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PopStyleVar();
    ImGui::GetWindowDrawList()->AddRectFilled(lo, hi, kGround, kit.px(10.0f));
    draw_task(kit, task, {lo.x + inset, lo.y + inset}, {hi.x - inset, hi.y - inset});
    ImGui::End();
    kit.parts.push_back({static_cast<std::uint32_t>(lo.x), static_cast<std::uint32_t>(lo.y),
                         static_cast<std::uint32_t>(width) + 1, static_cast<std::uint32_t>(height) + 1});
    kit.places["task"] = kit.parts.back();
}

namespace {

void show_row(Kit& kit, const std::vector<std::string>& cells, ImU32 colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float whole = kit.width();
    const auto columns = static_cast<float>(std::max<std::size_t>(cells.size(), 1));
    const float first = cells.size() > 2 ? kit.px(56.0f) : 0.5f * whole;
    const float each = (whole - first) / std::max(columns - 1.0f, 1.0f);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i == 0)
            kit.write(at, kDim, cells[i], kit.type.small);
        else
            kit.write_right(at.x + first + each * static_cast<float>(i), at.y, colour, cells[i], kit.type.small);
    }
    ImGui::Dummy({whole, kit.type.small->FontSize + kit.px(1.0f)});
}

}  // namespace

void show_tables(Kit& kit, const ActivityPanel& activity) {
    for (const ActivityPanel::Table& table : activity.tables) {
        if (kit.begin_card(table.title.c_str())) {
            const bool has_heads = std::ranges::any_of(table.heads, [](const auto& head) { return !head.empty(); });
            if (has_heads) show_row(kit, table.heads, kDim);
            for (const std::vector<std::string>& row : table.rows) show_row(kit, row, kText);
        }
        kit.end_card();
    }
}

}  // namespace burin::session::panel
