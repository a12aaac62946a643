// SPDX-License-Identifier: MIT
// Sections of the panel from top to bottom. Used by desk/panel/panel.cpp alone.
#pragma once

#include <functional>

#include "desk/panel/panel_widgets.hpp"

namespace burin::session::panel {

void show_header(Kit& kit, const PanelModel& model);
void show_activity(Kit& kit, const PanelModel& model);
// The activity's buttons, the line of their question, and its field; as high as acts_height() says, at scale 1.
void show_acts(Kit& kit, const ActivityPanel& activity);
[[nodiscard]] float acts_height(const ActivityPanel& activity);
// Returns all texts of its widgets, for the letters in them.
[[nodiscard]] std::string texts_of(const ActivityPanel& activity);
// The tables for who leads the session, a card each.
void show_tables(Kit& kit, const ActivityPanel& activity);
// What the person is doing now, drawn in an area of the current window; as high as task_height() says.
[[nodiscard]] float task_height(const Kit& kit, const ActivityPanel::Task& task, float width);
void draw_task(Kit& kit, const ActivityPanel::Task& task, ImVec2 lo, ImVec2 hi);
void show_hands(Kit& kit, const PanelModel& model);
void show_tool(Kit& kit, const PanelModel& model);
void show_material(Kit& kit, const PanelModel& model);
void show_objects(Kit& kit, const PanelModel& model);
void show_touch(Kit& kit, const PanelModel& model);
void show_touch_of_others(Kit& kit, const PanelModel& model);
// Says what a hand touches, and what its ticks tell of themselves: "in contact, sticking"; or why it gets no force.
[[nodiscard]] std::string touch_text(const PanelTouch& touch);
// Turns a cause into a sentence: "no force: the device has stopped sending" -> "The device has stopped sending."
[[nodiscard]] std::string sentence_of(std::string text);
void show_mouse(Kit& kit, const PanelModel& model);
void show_workspace(Kit& kit, const PanelModel& model);
void show_view(Kit& kit, const PanelModel& model);
void show_history(Kit& kit, const PanelModel& model);
void show_state(Kit& kit, const PanelModel& model);
void show_figures(Kit& kit, const PanelModel& model);
void show_plots(Kit& kit, const PanelModel& model);  // side by side, always visible
void show_help(Kit& kit, const PanelModel& model);
void show_devices(Kit& kit, const PanelModel& model);
void show_footer(Kit& kit, const PanelModel& model);
// The messages that are kept, in a card of one height, so that none of them moves anything.
void show_log(Kit& kit, const PanelModel& model);

// A part of the layout.
struct Area {
    ImVec2 lo{}, hi{};
};
// What lies over all else: messages in the lower left corner of an area, the card of first steps in its middle, and
// what a widget is for, beside the widget; left: of the panel, where there is room beside it.
void show_notes(Kit& kit, const PanelModel& model, const Area& free);
void show_task(Kit& kit, const ActivityPanel::Task& task, const Area& free);
void show_first_steps(Kit& kit, const PanelModel& model, const Area& free);
void show_tip(Kit& kit, const std::string& label, float left);
// What is opened, how far that is, and for how long it goes on.
void show_opening(Kit& kit, const PanelOpening& opening, const Area& free);
// Asks about the document, over all else; in the middle of the free area where there is room.
void show_question(Kit& kit, const PanelQuestion& question, const Area& free);
// Returns what the command of a label does, and the keys that do it too; empty where the label is no command's.
[[nodiscard]] std::string tip_of(std::string_view label);

// Colours of which one is chosen; as many as there are: none.
struct OfferedColours {
    std::span<const std::array<double, 3>> srgb;
    std::size_t chosen = 0;
};
// Draws these colours to choose from; gives another than the chosen one, once for each press.
void show_swatches(Kit& kit, const std::string& label, const OfferedColours& offered,
                   const std::function<void(const std::array<double, 3>&)>& give);
// Draws the usual colours and any other to choose from; gives the one chosen, which a hand may hold for a while.
void show_swatches(Kit& kit, const std::string& label, const std::array<double, 3>& now_srgb,
                   const std::function<void(const std::array<double, 3>&)>& give);

// Returns a tool of another kind and about the same width, with sizes that the parser accepts; the same tool where the
// panel does not offer the kind.
[[nodiscard]] toolbox::ToolSpec tool_like(const toolbox::ToolSpec& tool, toolbox::ToolKind kind);
// Returns the tool with one size changed, and the others where they must follow; one that has to be above zero becomes
// least_m.
[[nodiscard]] toolbox::ToolSpec with_size(toolbox::ToolSpec tool, std::size_t index, double size_m,
                                          double least_m = ToolSizeRange{}.from_m);

}  // namespace burin::session::panel
