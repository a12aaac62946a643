// SPDX-License-Identifier: MIT
// A display driven without any window system (VK_KHR_display), and its active stereo (VK_NV_display_stereo).
//
//   DeviceOptions options;
//   options.instance_extensions = direct_display_extensions();
//   options.optional_instance_extensions = direct_display_optional_extensions();
//   auto displays = list_displays(device);                        // what is plugged in and not taken by a desktop
//   auto surface = create_display_surface(device, {.stereo = DisplayStereo::hdmi_3d});
//   auto swapchain = Swapchain::create(device, std::move(surface->surface), {.layers = 2, .count_vblanks = true});
//
// A display that a desktop has taken is not listed by most drivers: run from a text console, or keep the display out of the
// desktop (NVIDIA's X driver: Option "AllowHMD", or the display switched off in the desktop's settings).
//
// What is chosen is tested as pure functions (display_choice.hpp), a session on such a display with another surface in its place
// (tests/app/session_direct_gpu.cpp). Of this file itself the tests reach the answer "no display": the rest follows the specification and
// waits for a machine with a stereo projector. The stereo structures are declared here by hand, as Debian 12's headers are older than
// the extension; they are those of VK_NV_display_stereo revision 1 (Vulkan registry, extension 552).
// Thread and lifetime: as Device.
#pragma once

#include <string>
#include <vector>

#include "gpu/core.hpp"
#include "gpu/display_choice.hpp"

namespace burin::gpu {

[[nodiscard]] std::vector<std::string> direct_display_extensions();
[[nodiscard]] std::vector<std::string> direct_display_optional_extensions();

// An Error when there is none, or when the device was opened without the extensions.
[[nodiscard]] Result<std::vector<DisplayInfo>> list_displays(Device& device);

// A surface, and what it shows on.
struct DisplaySurface {
    SurfaceHandle surface;
    std::string display;  // its name
    DisplayMode mode;
};

// The surface of a display in a mode; for Swapchain::create, with two layers where stereo is asked for. Errors name what is missing, and what
// there is instead: display, mode, plane, extension. A display shows one surface at a time: drop the one before, and wait for the device.
[[nodiscard]] Result<DisplaySurface> create_display_surface(Device& device, const DisplayChoice& choice);

}  // namespace burin::gpu
