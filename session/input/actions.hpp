// SPDX-License-Identifier: MIT
// Actions: commands without arguments, which a key can give as well, and the ways in which a mouse leads a hand. Which
// key gives which action is the desk's (desk/input/desk_input_table.hpp). Pure; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace burin::session {

// Names what a command without arguments does.
enum class Action : std::uint8_t {
    // clang-format off
    undo, redo, tool_1, tool_2, tool_3, tool_4, tool_5, smaller_radius, larger_radius, next_stereo_mode, swap_eyes,
    next_workspace_technique, toggle_panel, toggle_help, toggle_frame_figures, toggle_devices,
    toggle_full_screen, take_screenshot,
    export_mesh, save_session, save_as,
    reset_view, fit_view, fit_object, view_front, view_side, view_top, view_back, view_left, view_bottom,
    turn_left, turn_right, turn_up, turn_down, roll_left, roll_right, next_hand, put_away, first_steps, quit,
    // clang-format on
};
// How the mouse leads the hand's tool: along the surface that the cursor points at, or in free flight along the screen.
enum class MouseMode : std::uint8_t { free, surface };
// Bounds of how deep a stroke on the surface is, as a share of the tool's half width.
inline constexpr double kLeastStrength = 0.02, kMostStrength = 2.0;

// Returns an action's name, such as "undo"; the command of that name, in a log or from the panel, does the same.
[[nodiscard]] std::string_view name_of(Action action);
[[nodiscard]] std::span<const std::string_view> action_names();  // in the order of Action
// Returns what it does, in one line.
[[nodiscard]] std::string_view help_of(Action action);
// "free", "surface": as the option --mouse and the command have it.
[[nodiscard]] std::span<const std::string_view> mouse_mode_names();  // in the order of MouseMode
[[nodiscard]] std::string_view name_of(MouseMode mode);

}  // namespace burin::session
