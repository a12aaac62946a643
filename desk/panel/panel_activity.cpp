// SPDX-License-Identifier: MIT
// The panel's section for the activity: what the person is to do, what the activity has to tell, and its buttons.
#include <algorithm>
#include <array>
#include <optional>

#include "desk/panel/panel_sections.hpp"

namespace burin::session::panel {
namespace {

constexpr float kButtonHeight = 28.0f, kBetweenButtons = 6.0f;
constexpr std::size_t kMostFieldBytes = 200;

// Returns how many buttons of so many stand side by side: no more than their titles have room for, in rows as full as
// each other.
std::size_t buttons_across(std::size_t buttons) {
    constexpr std::size_t kMostInARow = 6;
    const std::size_t rows = (buttons + kMostInARow - 1) / kMostInARow;
    return std::max<std::size_t>(rows > 0 ? (buttons + rows - 1) / rows : 1, 1);
}

std::string label_of(const ActivityPanel::Button& button) {
    std::string label = "do";
    for (const std::string& word : button.act) label += " " + word;
    return label;
}

void show_buttons(Kit& kit, const ActivityPanel& activity) {
    const float space = kit.px(kBetweenButtons);
    const std::size_t across = buttons_across(activity.buttons.size());
    const auto count = static_cast<float>(across);
    const float each = (kit.width() - space * (count - 1.0f)) / count;
    for (std::size_t i = 0; i < activity.buttons.size(); ++i) {
        const ActivityPanel::Button& button = activity.buttons[i];
        if (i % across > 0) ImGui::SameLine(0.0f, space);
        const std::string label = label_of(button);
        if (!kit.button(label, button.title, each, button.enabled)) continue;
        kit.memory.asking = button.asks.empty() ? std::string() : label;
        if (button.asks.empty()) kit.give(DoAct{button.act});
    }
}

// A question that the panel asks before it does what a button is for.
struct Question {
    std::string label, title, asks;
    SessionCommand answer;
};

// Returns what is being asked: by a button of the activity, or by Quit, which would break off what the activity has
// under way.
std::optional<Question> question_of(const Kit& kit, const ActivityPanel& activity) {
    if (activity.governs && kit.memory.asking == name_of(Action::quit))
        return Question{kit.memory.asking, "Quit", "Quit? A stage under way is broken off.", RunAction{Action::quit}};
    for (const ActivityPanel::Button& button : activity.buttons)
        if (button.enabled && !button.asks.empty() && label_of(button) == kit.memory.asking)
            return Question{kit.memory.asking, button.title, button.asks, DoAct{button.act}};
    return std::nullopt;
}

// The line in which a button's question stands, empty while there is none. The answer that does it lies at the left:
// buttons that ask stand at the right, so that a second click in the same place does nothing.
void show_question(Kit& kit, const ActivityPanel& activity) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::optional<Question> asking = question_of(kit, activity);
    if (!asking) {
        kit.memory.asking.clear();
        const auto asks = [](const ActivityPanel::Button& button) { return !button.asks.empty(); };
        if (activity.governs || std::ranges::any_of(activity.buttons, asks))
            ImGui::Dummy({kit.width(), kit.px(kButtonHeight)});
        return;
    }
    const float each = kit.px(84.0f), space = kit.px(kBetweenButtons);
    const bool yes = kit.button("yes, " + asking->label, asking->title, each, true, true);
    ImGui::SameLine(0.0f, space);
    const bool no = kit.button("no", "No", 0.5f * each);
    const float left = at.x + 1.5f * each + 2.0f * space;
    kit.write({left, at.y + 0.5f * (kit.px(kButtonHeight) - kit.type.small->FontSize)}, kWarning, asking->asks,
              kit.type.small);
    if (yes) kit.give(asking->answer);
    if (!yes && !no) return;
    kit.memory.asking.clear();
    kit.again = true;  // without the question
}

void show_field(Kit& kit, const ActivityPanel& activity) {
    if (activity.field.empty()) return;
    std::array<char, kMostFieldBytes> bytes{};
    kit.memory.field.copy(bytes.data(), bytes.size() - 1);
    const float button = kit.px(64.0f), gap = kit.px(kBetweenButtons);
    ImGui::SetNextItemWidth(kit.width() - button - gap);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {kit.px(10.0f), 0.5f * (kit.px(kButtonHeight) - kit.type.text->FontSize)});
    const bool entered = ImGui::InputTextWithHint("##field", "a note that names nobody", bytes.data(), bytes.size(),
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    kit.note("field");
    ImGui::PopStyleVar();
    kit.memory.field = bytes.data();
    ImGui::SameLine(0.0f, gap);
    const bool written = !kit.memory.field.empty();
    const bool pressed = kit.button("do " + activity.field, "Note", button, written);
    if (!written || !(pressed || entered)) return;
    kit.give(DoAct{{activity.field, kit.memory.field}});
    kit.memory.field.clear();
}

}  // namespace

float acts_height(const ActivityPanel& activity) {
    const std::size_t across = buttons_across(activity.buttons.size());
    const std::size_t rows = (activity.buttons.size() + across - 1) / across + 1 + (activity.field.empty() ? 0 : 1);
    return static_cast<float>(rows) * (kButtonHeight + kBetweenButtons) + 8.0f;
}

void show_acts(Kit& kit, const ActivityPanel& activity) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, kit.px(kBetweenButtons)});
    show_buttons(kit, activity);
    show_question(kit, activity);
    show_field(kit, activity);
    ImGui::PopStyleVar();
}

void show_activity(Kit& kit, const PanelModel& model) {
    if (!model.activity) return;
    const ActivityPanel& activity = *model.activity;
    if (kit.begin_card(activity.title.c_str(), activity.aside)) {
        if (!activity.page.empty()) {
            kit.paragraph(kText, activity.page);
            kit.gap(6.0f);
        }
        for (const ActivityPanel::Row& row : activity.rows) kit.figure(row.name, row.value);
        if (!activity.governs && !activity.buttons.empty()) {
            kit.gap(4.0f);
            show_acts(kit, activity);
        }
    }
    kit.end_card();
}

}  // namespace burin::session::panel
