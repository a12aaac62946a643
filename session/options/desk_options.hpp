// SPDX-License-Identifier: MIT
// How a session is shown, and how it is led by who sees it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "session/options/edge_comfort.hpp"

namespace burin::session {

// How much of a picture is drawn while the view moves (desk/draw/drawn_detail.hpp).
enum class DetailChoice { automatic, full };

struct DeskOptions {
    bool live = false;       // explicitly requested; also implied when there is neither a stroke nor an output
    bool offscreen = false;  // no window; needs an input
    // Nobody sees it, in simulated time: no picture is made ready, and no tick is recorded without a file. No option
    // of the command line.
    bool unseen = false;
    std::string stereo;  // a mode's name; empty: mono in a window
    bool swap_eyes = false;
    EdgeComfort edge_comfort = EdgeComfort::automatic;  // on a lone screen
    std::string wall;  // wall file with screens, eyes and tracker; empty: one desktop window
    // A tracker's address, "udp:PORT", a file that describes one, or "none"; empty: the wall's, or keys fly the head.
    std::string tracker;
    bool windowed = false;    // the wall's screens as desktop windows, fitted into width x height
    std::string full_screen;  // a monitor's name or index; empty: a window
    // The panel has a window of its own and is on no picture; these show the activity's page alone.
    bool panel_window = false;
    // Size of the panel's letters; none: as the display asks, 1 in simulated time.
    std::optional<double> panel_scale = std::nullopt;
    // A person stands before a world: its picture fills what the panel leaves free, and the tool is under the cursor.
    // Logs and recordings from before are shown as they were. No option of the command line.
    bool frames_world = false;
    bool first_steps = false;  // a card of them is shown at first; no option of the command line
    int width = 1280, height = 720;
    std::uint32_t samples = 0;  // per pixel, 1 or 4; 0: 4 on hardware, 1 on a software device
    DetailChoice detail = DetailChoice::automatic;
    bool shadows = true;      // the objects of a world cast some
    std::string screenshots;  // folder for screenshots with a relative name; empty: the working directory
};

}  // namespace burin::session
