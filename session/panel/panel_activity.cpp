// SPDX-License-Identifier: MIT
// The panel's section for the activity: what the person is to do, what the activity has to tell, and its buttons.
#include <algorithm>

#include "session/panel/panel_sections.hpp"

namespace burin::session::panel {

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
        const auto count = static_cast<float>(std::max<std::size_t>(activity.buttons.size(), 1));
        const float each = (kit.width() - space * (count - 1.0f)) / count;
        if (!activity.buttons.empty()) kit.gap(4.0f);
        for (std::size_t i = 0; i < activity.buttons.size(); ++i) {
            const ActivityPanel::Button& button = activity.buttons[i];
            if (i > 0) ImGui::SameLine(0.0f, space);
            std::string label = "do";
            for (const std::string& word : button.act) label += " " + word;
            if (kit.button(label, button.title, each, button.enabled)) kit.give(DoAct{button.act});
        }
    }
    kit.end_card();
}

}  // namespace burin::session::panel
