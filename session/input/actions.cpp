// SPDX-License-Identifier: MIT
#include "session/input/actions.hpp"

#include <array>
#include <cstddef>

namespace burin::session {
namespace {

constexpr std::array<std::string_view, 2> kMouseModeNames = {"free", "surface"};

constexpr std::array<std::string_view, 40> kActionNames = {"undo",
                                                           "redo",
                                                           "tool-1",
                                                           "tool-2",
                                                           "tool-3",
                                                           "tool-4",
                                                           "tool-5",
                                                           "smaller-radius",
                                                           "larger-radius",
                                                           "next-stereo-mode",
                                                           "swap-eyes",
                                                           "next-workspace-technique",
                                                           "toggle-panel",
                                                           "toggle-help",
                                                           "toggle-frame-figures",
                                                           "toggle-devices",
                                                           "toggle-full-screen",
                                                           "take-screenshot",
                                                           "export-mesh",
                                                           "save-session",
                                                           "save-as",
                                                           "reset-view",
                                                           "fit-view",
                                                           "fit-object",
                                                           "view-front",
                                                           "view-side",
                                                           "view-top",
                                                           "view-back",
                                                           "view-left",
                                                           "view-bottom",
                                                           "turn-left",
                                                           "turn-right",
                                                           "turn-up",
                                                           "turn-down",
                                                           "roll-left",
                                                           "roll-right",
                                                           "next-hand",
                                                           "put-away",
                                                           "first-steps",
                                                           "quit"};
static_assert(kActionNames[static_cast<std::size_t>(Action::quit)] == "quit");

}  // namespace

std::string_view name_of(Action action) { return kActionNames.at(static_cast<std::size_t>(action)); }
std::span<const std::string_view> action_names() { return kActionNames; }
std::span<const std::string_view> mouse_mode_names() { return kMouseModeNames; }
std::string_view name_of(MouseMode mode) { return kMouseModeNames.at(static_cast<std::size_t>(mode)); }

}  // namespace burin::session
