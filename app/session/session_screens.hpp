// SPDX-License-Identifier: MIT
// The screens that a session is seen on: a desk's window, which stands for a wall of its own shape, or those of a wall file.
// Pure data and functions; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/session_options.hpp"
#include "gpu/display_choice.hpp"
#include "renderer/output/output_settings.hpp"
#include "renderer/stereo/wall.hpp"

namespace burin {

struct SessionScreen {
    std::string name;     // empty at a desk
    std::string monitor;  // which it fills; empty: a window on the desktop, or a display of its own
    std::optional<gpu::DisplayChoice> direct;  // that display; nothing: a window
    ImageSize size;                            // of its output in pixels; a window on the desktop begins with it
    OutputSettings shown;                      // as the wall file has it
};

struct SessionWall {
    WallSetup setup;
    std::vector<SessionScreen> screens;  // one for each of the setup's, in its order
    std::size_t main = 0;                // the one that the viewer faces at first: it has the mouse and the workpiece
    bool desk = true;                    // of one screen that follows its window's shape, and no wall file
};

// As the options say. Errors: those of the wall file, a screen whose mode is unknown or contradicts the way in which it is driven.
[[nodiscard]] Result<SessionWall> session_wall(const LiveOptions& options);

// A desk's screen takes the shape of an eye's picture.
void fit_desk_screen(SessionWall& wall, ImageSize eye);

// How a screen is shown, given what all screens have been told since: a mode other than that of the main screen's file is for all.
[[nodiscard]] OutputSettings output_on(const SessionWall& wall, std::size_t screen, const OutputSettings& told);

// To the right, up and out of a screen.
[[nodiscard]] Quat world_from_screen(const Screen& screen);

}  // namespace burin
