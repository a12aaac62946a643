// SPDX-License-Identifier: MIT
// Chooses the display, mode and plane for output without any window system (direct_display.hpp): plain data and pure
// functions, so that the choice can be tested without such a display. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/display_stereo.hpp"

namespace burin::gpu {

struct DisplayMode {
    std::uint32_t width = 0, height = 0;  // pixels
    double refresh_Hz = 0.0;
    bool hdmi_3d = false;  // can be sent as HDMI 3D; false where the driver cannot tell
};

struct DisplayInfo {
    std::string name;
    double width_mm = 0.0, height_mm = 0.0;
    std::vector<DisplayMode> modes;
};

struct DisplayChoice {
    std::string display = {};             // its name, a part of it, or its index in the list; empty: the first
    std::uint32_t width = 0, height = 0;  // 0: the display's native size
    double refresh_Hz = 0.0;              // 0: the fastest
    DisplayStereo stereo = DisplayStereo::none;
};

// Returns the index of the display meant: the one with exactly this name, else the one at this index, else the first
// whose name contains this text; -1: none.
[[nodiscard]] int choose_display(const std::vector<std::string>& names, const std::string& wanted);

// Returns the index of the mode that fits a choice best; -1 when none has the size, or supports HDMI 3D where that is
// asked for. Among the modes of the right size, takes the one whose refresh rate is nearest to the choice, or the
// fastest.
[[nodiscard]] int choose_mode(const std::vector<DisplayMode>& modes, const DisplayChoice& choice);

// A display plane: the source that a display scans out.
struct DisplayPlane {
    bool reaches = false;                           // can be shown on the chosen display
    bool shows = false;                             // is shown on it already
    bool taken = false;                             // is shown on another display
    std::uint32_t alpha = 0;                        // supported VkDisplayPlaneAlphaFlagsKHR
    std::uint32_t most_width = 0, most_height = 0;  // largest image in pixels; 0: not reported
};

// Returns the index of the plane for an image of this size: one that the display shows already, else the first free
// one; -1: none.
[[nodiscard]] int choose_plane(const std::vector<DisplayPlane>& planes, std::uint32_t width, std::uint32_t height);

// Returns the opaque VkDisplayPlaneAlphaFlagBitsKHR where the plane supports it; else a supported one that shows an
// opaque image unchanged.
[[nodiscard]] std::uint32_t choose_alpha(std::uint32_t supported);

// Formats modes for messages: "1920 x 1080 at 60, 24 Hz (HDMI 3D at 24 Hz); 1280 x 720 at 60 Hz".
[[nodiscard]] std::string listed(const std::vector<DisplayMode>& modes);

}  // namespace burin::gpu
