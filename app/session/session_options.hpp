// SPDX-License-Identifier: MIT
// How a live session is shown and fed: the options of `burin sculpt` beside those of carving.
#pragma once

#include <cstdint>
#include <string>

namespace burin {

struct LiveOptions {
    bool live = false;       // asked for by name; also meant when there is neither a stroke nor an output
    std::string input;       // a log or a script that takes the user's place; empty: keyboard, mouse, trackers
    std::string record;      // where to record the input; empty: nowhere
    bool offscreen = false;  // no window; needs an input
    std::string stereo;      // a mode's name; empty: mono in a window
    bool swap_eyes = false;
    std::string wall;         // a wall file: its screens, eyes and tracker; empty: one window, on a desk
    std::string tracker;      // where one is heard, "udp:PORT"; empty: keys fly the head
    bool windowed = false;    // the wall's screens in windows on the desktop, fitted into width x height
    std::string full_screen;  // a monitor's name or index; empty: a window
    int width = 1280, height = 720;
    std::uint32_t samples = 0;  // a pixel: 1 or 4; 0: 4 on hardware, 1 on a software device
    std::string screenshots;    // the folder for pictures that are asked for by a relative name; empty: here
};

}  // namespace burin
