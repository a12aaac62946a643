// SPDX-License-Identifier: MIT
// The panel's section for the activity: what the person is to do, what the activity has to tell, and its buttons.
#include <algorithm>

#include "session/panel/panel_sections.hpp"

namespace burin::session::panel {
namespace {

// Returns how many buttons of so many stand side by side: no more than their titles have room for, in rows as full as
// each other.
std::size_t buttons_across(std::size_t buttons) {
    constexpr std::size_t kMostInARow = 6;
    const std::size_t rows = (buttons + kMostInARow - 1) / kMostInARow;
    return std::max<std::size_t>(rows > 0 ? (buttons + rows - 1) / rows : 1, 1);
}

}  // namespace

void show_activity(Kit& kit, const PanelModel& model) {
    if (!model.activity) return;
    const ActivityPanel& activity = *model.activity;
    if (kit.begin_card(activity.title.c_str(), activity.aside)) {
        if (!activity.page.empty()) {
            kit.paragraph(kText, activity.page);
            kit.gap(6.0f);
        }
        for (const ActivityPanel::Row& row : activity.rows) kit.figure(row.name, row.value);
        const float space = kit.px(6.0f);
        const std::size_t across = buttons_across(activity.buttons.size());
        const auto count = static_cast<float>(across);
        const float each = (kit.width() - space * (count - 1.0f)) / count;
        if (!activity.buttons.empty()) kit.gap(4.0f);
        for (std::size_t i = 0; i < activity.buttons.size(); ++i) {
            const ActivityPanel::Button& button = activity.buttons[i];
            if (i % across > 0) ImGui::SameLine(0.0f, space);
            std::string label = "do";
            for (const std::string& word : button.act) label += " " + word;
            if (kit.button(label, button.title, each, button.enabled)) kit.give(DoAct{button.act});
        }
    }
    kit.end_card();
}

}  // namespace burin::session::panel
