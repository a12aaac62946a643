// SPDX-License-Identifier: MIT
// Screens that a session is shown on: one desktop window, which stands for a wall of its own shape, or the screens of a
// wall file. Pure data and functions; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/display_choice.hpp"
#include "session/options/desk_options.hpp"
#include "wall/output_settings.hpp"
#include "wall/wall.hpp"

namespace burin::session {

struct SessionScreen {
    std::string name;                          // empty for a desktop window
    std::string monitor;                       // the monitor it fills; empty: a window, or a direct display
    std::optional<gpu::DisplayChoice> direct;  // the direct display; none: a window
    ImageSize size;                            // of its output in pixels; a desktop window's initial size
    wall::OutputSettings shown;                // as the wall file sets it
};

struct SessionWall {
    wall::WallSetup setup;
    // One for each of the setup's screens, in the same order; behind them one that shows the panel alone, if any does.
    std::vector<SessionScreen> screens;
    std::size_t main = 0;  // faced by the viewer at first; has mouse and workpiece
    bool desk = true;      // one screen that follows its window's shape; no wall file

    [[nodiscard]] bool is_panel(std::size_t screen) const { return screen >= setup.screens.size(); }
    [[nodiscard]] bool has_panel_window() const { return screens.size() > setup.screens.size(); }
};

// Builds the wall that the options ask for. Errors: those of the wall file; a screen whose mode is unknown or
// contradicts how the screen is driven.
[[nodiscard]] Result<SessionWall> session_wall(const DeskOptions& options);

// Gives a desktop window's screen the shape of an eye's picture; changes no other wall.
void fit_desk_screen(SessionWall& wall, ImageSize eye);

// Returns how a screen is shown, given the settings that the session has changed since: a mode other than the one in
// the main screen's file applies to all screens. The panel's is shown as it is.
[[nodiscard]] wall::OutputSettings output_on(const SessionWall& wall, std::size_t screen,
                                             const wall::OutputSettings& told);

// Returns the orientation of a screen: its axes point to the right, up and out of it.
[[nodiscard]] Quat world_from_screen(const wall::Screen& screen);

}  // namespace burin::session
