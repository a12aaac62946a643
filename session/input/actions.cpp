// SPDX-License-Identifier: MIT
#include "session/input/actions.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace burin::session {
namespace {

constexpr std::array<std::string_view, 2> kMouseModeNames = {"free", "surface"};

struct ActionRow {
    Action action;
    std::string_view name, help;
};
constexpr std::array<ActionRow, 40> kActions = {{
    {Action::undo, "undo", "Undo"},
    {Action::redo, "redo", "Redo"},
    {Action::tool_1, "tool-1", "Cut"},
    {Action::tool_2, "tool-2", "Fill: add material"},
    {Action::tool_3, "tool-3", "Paint"},
    {Action::tool_4, "tool-4", "Smooth"},
    {Action::tool_5, "tool-5", "Only touch"},
    {Action::smaller_radius, "smaller-radius", "Smaller tool"},
    {Action::larger_radius, "larger-radius", "Larger tool"},
    {Action::next_stereo_mode, "next-stereo-mode", "Next stereo mode"},
    {Action::swap_eyes, "swap-eyes", "Exchange the eyes"},
    {Action::next_workspace_technique, "next-workspace-technique", "Next way to move the workspace"},
    {Action::toggle_panel, "toggle-panel", "Show or hide the panel"},
    {Action::toggle_help, "toggle-help", "Show or hide this help"},
    {Action::toggle_frame_figures, "toggle-frame-figures", "Show or hide the figures of frames and ticks"},
    {Action::toggle_devices, "toggle-devices", "Show which devices there are, and why others are not"},
    {Action::toggle_full_screen, "toggle-full-screen", "Full screen or window"},
    {Action::take_screenshot, "take-screenshot", "Save a picture of the screen"},
    {Action::export_mesh, "export-mesh", "Export the mesh"},
    {Action::save_session, "save-session", "Save the work"},
    {Action::save_as, "save-as", "Save the work under another name"},
    {Action::reset_view, "reset-view", "Back to the first view"},
    {Action::fit_view, "fit-view", "Show all of the workpiece"},
    {Action::fit_object, "fit-object", "Show the chosen object of a world"},
    {Action::view_front, "view-front", "From the front"},
    {Action::view_side, "view-side", "From the right side"},
    {Action::view_top, "view-top", "From above"},
    {Action::view_back, "view-back", "From behind"},
    {Action::view_left, "view-left", "From the left side"},
    {Action::view_bottom, "view-bottom", "From below"},
    {Action::turn_left, "turn-left", "Turn the scene to the left"},
    {Action::turn_right, "turn-right", "Turn the scene to the right"},
    {Action::turn_up, "turn-up", "Turn the scene upwards"},
    {Action::turn_down, "turn-down", "Turn the scene downwards"},
    {Action::roll_left, "roll-left", "Turn the tool about its axis"},
    {Action::roll_right, "roll-right", "Turn the tool about its axis"},
    {Action::next_hand, "next-hand", "Lead the next hand, of several"},
    {Action::put_away, "put-away", "Put messages away"},
    {Action::first_steps, "first-steps", "Show what the mouse does, in four pictures"},
    {Action::quit, "quit", "Quit"},
}};
static_assert(std::ranges::all_of(kActions, [](const ActionRow& row) {
    return &row == &kActions.at(static_cast<std::size_t>(row.action));
}));

constexpr auto kActionNames = [] {
    std::array<std::string_view, kActions.size()> names;
    std::ranges::transform(kActions, names.begin(), &ActionRow::name);
    return names;
}();

}  // namespace

std::string_view name_of(Action action) { return kActions.at(static_cast<std::size_t>(action)).name; }
std::string_view help_of(Action action) { return kActions.at(static_cast<std::size_t>(action)).help; }
std::span<const std::string_view> action_names() { return kActionNames; }
std::span<const std::string_view> mouse_mode_names() { return kMouseModeNames; }
std::string_view name_of(MouseMode mode) { return kMouseModeNames.at(static_cast<std::size_t>(mode)); }

}  // namespace burin::session
