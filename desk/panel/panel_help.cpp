// SPDX-License-Identifier: MIT
// Shows short cuts, mouse and commands from the tables that act on them, so that help cannot differ from what happens.
#include <algorithm>

#include "desk/input/desk_input_table.hpp"
#include "desk/panel/panel_sections.hpp"
#include "session/state/command_table.hpp"

namespace burin::session::panel {

namespace {

struct HelpLine {
    std::string keys, text;
};

// Adds a line; keys that do the same share one.
void add_line(std::vector<HelpLine>& lines, std::string keys, std::string_view text) {
    const auto same = std::ranges::find(lines, text, &HelpLine::text);
    if (same == lines.end()) {
        lines.push_back({std::move(keys), std::string(text)});
    } else if (same->keys != keys) {
        same->keys += ", " + keys;
    }
}

void show_lines(Kit& kit, const std::vector<HelpLine>& lines, float keys_width) {
    for (const HelpLine& line : lines) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float left = kit.px(keys_width);
        const auto part = [&](float from, float width, ImU32 colour, const std::string& text) {
            ImGui::SetCursorScreenPos({at.x + from, at.y});
            ImGui::PushFont(kit.type.small);
            ImGui::PushStyleColor(ImGuiCol_Text, colour);
            ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
            ImGui::TextUnformatted(text.c_str());
            ImGui::PopTextWrapPos();
            ImGui::PopStyleColor();
            ImGui::PopFont();
            return ImGui::GetItemRectMax().y;
        };
        const float whole = kit.width();
        const float bottom =
            std::max(part(0.0f, left - kit.px(8.0f), kAccent, line.keys), part(left, whole - left, kText, line.text));
        ImGui::SetCursorScreenPos({at.x, bottom + kit.px(4.0f)});
    }
}

// Keys that have nothing to do with a scene.
bool is_of_the_session(Action action) {
    switch (action) {
        case Action::put_away:
        case Action::toggle_panel:
        case Action::toggle_help:
        case Action::toggle_frame_figures:
        case Action::toggle_devices:
        case Action::toggle_full_screen:
        case Action::take_screenshot:
        case Action::quit: return true;
        default: return false;
    }
}

void show_flight(Kit& kit) {
    if (kit.begin_card("Moving the head")) {
        std::vector<HelpLine> lines;
        for (const FlightKey& key : flight_keys()) add_line(lines, label_of(key), key.description);
        show_lines(kit, lines, 104.0f);
    }
    kit.end_card();
}

// What the activity is about, and the keys of its buttons.
void show_activity_help(Kit& kit, const ActivityPanel& activity) {
    if (activity.help.empty()) return;
    if (kit.begin_card(activity.title.c_str())) {
        for (const std::string& paragraph : activity.help) {
            kit.paragraph(kText, paragraph);
            kit.gap(6.0f);
        }
        std::vector<HelpLine> lines;
        for (const ActivityPanel::Button& button : activity.buttons())
            if (button.key) add_line(lines, label_of(ShortCut{*button.key, {}, {}, false, {}}), button.title);
        for (const ActivityPanel::Choice& choice : activity.all<ActivityPanel::Choice>())
            if (choice.key) add_line(lines, label_of(ShortCut{*choice.key, {}, {}, false, {}}), choice.name);
        show_lines(kit, lines, 104.0f);
    }
    kit.end_card();
}

}  // namespace

void show_help(Kit& kit, const PanelModel& model) {
    const MouseMode mouse = model.mouse;
    const bool hides_scene = model.activity && model.activity->hides_scene;
    if (model.activity) show_activity_help(kit, *model.activity);
    if (mouse == MouseMode::surface) {
        const float wide = ImGui::GetContentRegionAvail().x - kit.px(2.0f);
        if (kit.button("first-steps", "Show the first steps", wide)) kit.give(RunAction{Action::first_steps});
        kit.gap(6.0f);
    }
    if (kit.begin_card("Keys")) {
        std::vector<HelpLine> lines;
        for (const ShortCut& cut : short_cuts())
            if ((!cut.only || *cut.only == mouse) && (!hides_scene || is_of_the_session(cut.action)))
                add_line(lines, label_of(cut), help_of(cut.action));
        show_lines(kit, lines, 104.0f);
    }
    kit.end_card();
    if (hides_scene) return;
    if (mouse == MouseMode::free) show_flight(kit);
    if (kit.begin_card("Mouse")) {
        std::vector<HelpLine> lines;
        for (const MouseGesture& gesture : mouse_gestures(mouse))
            add_line(lines, label_of(gesture), gesture.description);
        show_lines(kit, lines, 104.0f);
    }
    kit.end_card();
    if (kit.begin_card("Commands for scripts")) {
        std::vector<HelpLine> lines;
        for (const CommandSpec& command : commands()) {
            if (command.arguments.empty()) continue;
            lines.push_back(
                {std::string(command.name) + " " + std::string(command.arguments), std::string(command.help)});
        }
        show_lines(kit, lines, 104.0f);
        std::string names = "Without arguments:";
        for (const CommandSpec& command : commands()) {
            if (command.arguments.empty()) names += (names.back() == ':' ? " " : ", ") + std::string(command.name);
        }
        kit.paragraph(kDim, names);
    }
    kit.end_card();
}

void show_footer(Kit& kit, const PanelModel& model) {
    const float gap = kit.px(6.0f), each = (ImGui::GetContentRegionAvail().x - 3.0f * gap) / 4.0f;
    struct Entry {
        Action action;
        const char* text;
        bool on;
    };
    const std::array<Entry, 4> entries{{{Action::toggle_help, "Help", model.show_help},
                                        {Action::toggle_frame_figures, "Figures", model.show_figures},
                                        {Action::toggle_panel, "Hide", false},
                                        {Action::quit, "Quit", false}}};
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (i > 0) ImGui::SameLine(0.0f, gap);
        const Action action = entries[i].action;
        const bool stays = action == Action::toggle_panel && !model.may_be_hidden;
        kit.off(stays ? "The panel has this window to itself." : "");
        if (!kit.button(std::string(name_of(action)), entries[i].text, each, !stays, entries[i].on, 26.0f)) continue;
        if (action == Action::quit && model.activity && model.activity->governs)
            kit.memory.asking = name_of(action);  // show_acts() asks
        else
            kit.give(RunAction{action});
    }
    kit.off({});
}

}  // namespace burin::session::panel
