// SPDX-License-Identifier: MIT
// A display driven without any window system (VK_KHR_display), and its active stereo (VK_NV_display_stereo).
//
//   DeviceOptions options;
//   options.instance_extensions = direct_display_extensions();
//   options.optional_instance_extensions = direct_display_optional_extensions();
//   auto displays = list_displays(device);                        // what is plugged in and not taken by a desktop
//   auto surface = create_display_surface(device, {.stereo = DisplayStereo::hdmi_3d});
//   auto swapchain = Swapchain::create(device, std::move(*surface), {.layers = 2, .count_vblanks = true});
//
// A display that a desktop has taken is not listed by most drivers: run from a text console, or keep the display out of the
// desktop (NVIDIA's X driver: Option "AllowHMD", or the display switched off in the desktop's settings).
//
// Tested without such a display only as far as the answer "no display"; the rest follows the specification and waits for a
// machine with a stereo projector. The stereo structures are declared here by hand, as Debian 12's headers are older than
// the extension; they are those of VK_NV_display_stereo revision 1 (Vulkan registry, extension 552).
// Thread and lifetime: as Device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/core.hpp"

namespace burin::gpu {

// How a display separates the eyes.
enum class DisplayStereo {
    none,
    onboard_din,         // an emitter at the graphics card's DIN connector
    hdmi_3d,             // frame packing: both pictures in one frame of twice the height
    inband_displayport,  // the eye is told in the DisplayPort signal
};
[[nodiscard]] const char* name_of(DisplayStereo stereo);

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
    std::string display = {};             // part of a display's name; empty: the first
    std::uint32_t width = 0, height = 0;  // 0: the display's own
    double refresh_Hz = 0.0;              // 0: the fastest
    DisplayStereo stereo = DisplayStereo::none;
};

[[nodiscard]] std::vector<std::string> direct_display_extensions();
[[nodiscard]] std::vector<std::string> direct_display_optional_extensions();

// An Error when there is none, or when the device was opened without the extensions.
[[nodiscard]] Result<std::vector<DisplayInfo>> list_displays(Device& device);

// Which mode of a display fits a choice best; -1 when none has the size, or can do HDMI 3D where that is asked for. Of the
// modes of the right size the one whose refresh rate is nearest, or the fastest. Pure.
[[nodiscard]] int choose_mode(const std::vector<DisplayMode>& modes, const DisplayChoice& choice);

// The surface of a display in a mode; for Swapchain::create. Errors name what is missing: display, mode, plane, extension.
[[nodiscard]] Result<SurfaceHandle> create_display_surface(Device& device, const DisplayChoice& choice);

}  // namespace burin::gpu
