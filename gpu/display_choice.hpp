// SPDX-License-Identifier: MIT
// Which display, mode and plane a picture is sent to without any window system (direct_display.hpp): plain data and pure functions, so that
// the choice can be tested without such a display. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace burin::gpu {

// How a display separates the eyes.
enum class DisplayStereo : std::uint8_t {
    none,
    onboard_din,         // an emitter at the graphics card's DIN connector
    hdmi_3d,             // frame packing: both pictures in one frame of twice the height
    inband_displayport,  // the eye is told in the DisplayPort signal
};
[[nodiscard]] const char* name_of(DisplayStereo stereo);  // "plain", "onboard-din", "hdmi-3d", "inband-displayport"
[[nodiscard]] std::span<const DisplayStereo> display_stereos();

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
    std::string display = {};             // its name, a part of it, or its place in the list; empty: the first
    std::uint32_t width = 0, height = 0;  // 0: the display's own
    double refresh_Hz = 0.0;              // 0: the fastest
    DisplayStereo stereo = DisplayStereo::none;
};

// Which display is meant: the one of this whole name, else of this place in the list, else the first whose name has this part; -1: none.
[[nodiscard]] int choose_display(const std::vector<std::string>& names, const std::string& wanted);

// Which mode of a display fits a choice best; -1 when none has the size, or can do HDMI 3D where that is asked for. Of the modes of the
// right size the one whose refresh rate is nearest, or the fastest.
[[nodiscard]] int choose_mode(const std::vector<DisplayMode>& modes, const DisplayChoice& choice);

// What a display draws its picture from.
struct DisplayPlane {
    bool reaches = false;                           // can show on the display that is meant
    bool shows = false;                             // already does
    bool taken = false;                             // shows on another one
    std::uint32_t alpha = 0;                        // VkDisplayPlaneAlphaFlagsKHR that it can
    std::uint32_t most_width = 0, most_height = 0;  // pixels of a picture; 0: it does not say
};

// Which plane to take for a picture of a size: one that shows on the display already, else the first free one; -1: none.
[[nodiscard]] int choose_plane(const std::vector<DisplayPlane>& planes, std::uint32_t width, std::uint32_t height);

// Opaque where the plane can; else what it can that shows an opaque picture as it is. VkDisplayPlaneAlphaFlagBitsKHR.
[[nodiscard]] std::uint32_t choose_alpha(std::uint32_t supported);

// "1920 x 1080 at 60, 24 Hz (HDMI 3D at 24 Hz); 1280 x 720 at 60 Hz": for people.
[[nodiscard]] std::string listed(const std::vector<DisplayMode>& modes);

}  // namespace burin::gpu
