// SPDX-License-Identifier: MIT
// The ways in which a display driven without a window system separates the eyes: named in wall files, requested from
// the driver (gpu/direct_display.hpp). Whether a display offers one of them is known only when it is opened.
// All but none take the two pictures of StereoMode::two_layers, and none takes one: check_modes() (wall/wall.hpp)
// finds walls that contradict this.
// Plain data; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace burin {

enum class DisplayStereo : std::uint8_t {
    none,                // one picture: mono, or a mode that arranges both eyes in it
    onboard_din,         // an emitter at the graphics card's DIN connector
    hdmi_3d,             // frame packing: both images in one frame of twice the height
    inband_displayport,  // the DisplayPort signal says which eye a frame is for
};

// Returns the mode's name in wall files.
[[nodiscard]] constexpr const char* name_of(DisplayStereo stereo) {
    switch (stereo) {
        case DisplayStereo::none: return "plain";
        case DisplayStereo::onboard_din: return "onboard-din";
        case DisplayStereo::hdmi_3d: return "hdmi-3d";
        case DisplayStereo::inband_displayport: return "inband-displayport";
    }
    return "?";
}

// Returns all modes, in the order in which messages list them.
[[nodiscard]] inline std::span<const DisplayStereo> display_stereos() {
    static constexpr std::array kAll{DisplayStereo::none, DisplayStereo::hdmi_3d, DisplayStereo::onboard_din,
                                     DisplayStereo::inband_displayport};
    return kAll;
}

}  // namespace burin
