// SPDX-License-Identifier: MIT
// Access to a display without any window system (VK_KHR_display), and to its active stereo (VK_NV_display_stereo).
//
//   DeviceOptions options;
//   options.instance_extensions = direct_display_extensions();
//   options.optional_instance_extensions = direct_display_optional_extensions();
//   auto displays = list_displays(device);                        // those plugged in and not used by a desktop
//   auto surface = create_display_surface(device, {.stereo = DisplayStereo::hdmi_3d});
//   auto swapchain = Swapchain::create(device, std::move(surface->surface), {.layers = 2, .count_vblanks = true});
//
// Most drivers do not list a display that a desktop uses: run from a text console, or keep the display out of the
// desktop (NVIDIA's X driver: Option "AllowHMD", or the display switched off in the desktop's settings).
//
// Tests cover the choice of display, mode and plane as pure functions (display_choice.hpp), and a session on such a
// display with another surface in its place (tests/desk/session_direct_gpu.cpp). Of this file itself they reach only
// the answer "no display": the rest follows the specification and has yet to run on a machine with a stereo projector.
// The stereo structures are declared here by hand, as Debian 12's headers are older than the extension; they are those
// of VK_NV_display_stereo revision 1 (Vulkan registry, extension 552).
// Thread and lifetime: as Device.
#pragma once

#include <string>
#include <vector>

#include "gpu/core.hpp"
#include "gpu/display_choice.hpp"

namespace burin::gpu {

[[nodiscard]] std::vector<std::string> direct_display_extensions();
[[nodiscard]] std::vector<std::string> direct_display_optional_extensions();

// Lists the displays. An Error when there is none, or when the device was opened without the extensions.
[[nodiscard]] Result<std::vector<DisplayInfo>> list_displays(Device& device);

// A surface, and the display and mode that it presents to.
struct DisplaySurface {
    SurfaceHandle surface;
    std::string display;  // name of the display
    DisplayMode mode;
};

// Creates the surface of a display in a mode; for Swapchain::create, with two layers where stereo is asked for. Errors
// name the display, mode, plane or extension that is missing, and the available ones. A display shows one surface at a
// time: destroy the previous one first, and wait for the device.
[[nodiscard]] Result<DisplaySurface> create_display_surface(Device& device, const DisplayChoice& choice);

}  // namespace burin::gpu
