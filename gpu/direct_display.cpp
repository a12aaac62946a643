// SPDX-License-Identifier: MIT
#include "gpu/direct_display.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace burin::gpu {

namespace {

constexpr const char* kStereoExtension = "VK_NV_display_stereo";
constexpr const char* kWhere = "direct display";

// VK_NV_display_stereo, by hand: extension 552 numbers its values from 1000551000.
enum StereoType : std::int32_t { kStereoNone = 0, kStereoDin = 1, kStereoHdmi = 2, kStereoInband = 3 };
constexpr auto kSurfaceStereoCreateInfo = static_cast<VkStructureType>(1000551000);
constexpr auto kModeStereoProperties = static_cast<VkStructureType>(1000551001);
struct DisplaySurfaceStereoCreateInfo {
    VkStructureType sType;
    const void* pNext;
    std::int32_t stereoType;
};
struct DisplayModeStereoProperties {
    VkStructureType sType;
    const void* pNext;
    VkBool32 hdmi3DSupported;
};

std::int32_t vulkan_type(DisplayStereo stereo) {
    switch (stereo) {
        case DisplayStereo::none: return kStereoNone;
        case DisplayStereo::onboard_din: return kStereoDin;
        case DisplayStereo::hdmi_3d: return kStereoHdmi;
        case DisplayStereo::inband_displayport: return kStereoInband;
    }
    return kStereoNone;
}

// The instance's functions for displays.
struct Functions {
    PFN_vkGetPhysicalDeviceDisplayPropertiesKHR displays = nullptr;
    PFN_vkGetPhysicalDeviceDisplayPlanePropertiesKHR planes = nullptr;
    PFN_vkGetDisplayPlaneSupportedDisplaysKHR plane_displays = nullptr;
    PFN_vkGetDisplayModeProperties2KHR modes = nullptr;
    PFN_vkGetDisplayPlaneCapabilitiesKHR plane_capabilities = nullptr;
    PFN_vkCreateDisplayPlaneSurfaceKHR create_surface = nullptr;

    explicit Functions(VkInstance instance) {
        load(displays, instance, "vkGetPhysicalDeviceDisplayPropertiesKHR");
        load(planes, instance, "vkGetPhysicalDeviceDisplayPlanePropertiesKHR");
        load(plane_displays, instance, "vkGetDisplayPlaneSupportedDisplaysKHR");
        load(modes, instance, "vkGetDisplayModeProperties2KHR");
        load(plane_capabilities, instance, "vkGetDisplayPlaneCapabilitiesKHR");
        load(create_surface, instance, "vkCreateDisplayPlaneSurfaceKHR");
    }
    [[nodiscard]] bool complete() const { return displays && planes && plane_displays && modes && create_surface; }

private:
    template <typename F>
    static void load(F& function, VkInstance instance, const char* name) {
        function = reinterpret_cast<F>(vkGetInstanceProcAddr(instance, name));
    }
};

struct Display {
    VkDisplayKHR handle = VK_NULL_HANDLE;
    VkExtent2D native{};
    DisplayInfo info;
    std::vector<VkDisplayModeKHR> mode_handles;
};

void read_modes(const Core& core, const Functions& f, Display& display) {
    std::uint32_t count = 0;
    f.modes(core.physical, display.handle, &count, nullptr);
    std::vector<DisplayModeStereoProperties> stereo(count, {kModeStereoProperties, nullptr, VK_FALSE});
    std::vector<VkDisplayModeProperties2KHR> found(
        count, structure<VkDisplayModeProperties2KHR>(VK_STRUCTURE_TYPE_DISPLAY_MODE_PROPERTIES_2_KHR));
    if (core.capabilities.display_stereo) {
        for (std::size_t i = 0; i < count; ++i) found[i].pNext = &stereo[i];
    }
    if (f.modes(core.physical, display.handle, &count, found.data()) < VK_SUCCESS) return;
    for (std::size_t i = 0; i < count; ++i) {
        const VkDisplayModePropertiesKHR& mode = found[i].displayModeProperties;
        display.info.modes.push_back({mode.parameters.visibleRegion.width, mode.parameters.visibleRegion.height,
                                      mode.parameters.refreshRate / 1000.0, stereo[i].hdmi3DSupported == VK_TRUE});
        display.mode_handles.push_back(mode.displayMode);
    }
}

Result<std::vector<Display>> find_displays(const Core& core, const Functions& f) {
    if (!f.complete() || core.surface.destroy == nullptr) {
        return fail(kWhere, "the driver cannot drive a display by itself (VK_KHR_display)",
                    "update the graphics driver, or show the picture in a window");
    }
    std::uint32_t count = 0;
    VkResult r = f.displays(core.physical, &count, nullptr);
    std::vector<VkDisplayPropertiesKHR> found(count);
    if (r == VK_SUCCESS && count > 0) r = f.displays(core.physical, &count, found.data());
    if (r < VK_SUCCESS) return vulkan_failure(kWhere, core.info.name + " cannot list its displays", r);
    found.resize(count);
    if (found.empty()) {
        return fail(
            kWhere, "no display that " + core.info.name + " could drive by itself",
            "plug one in, or free it from the desktop (leave the desktop for a text console, or switch the display "
            "off in the desktop's settings), or show the picture in a window");
    }
    std::vector<Display> displays;
    for (const VkDisplayPropertiesKHR& p : found) {
        Display display;
        display.handle = p.display;
        display.native = p.physicalResolution;
        display.info.name = p.displayName != nullptr ? p.displayName : "display " + std::to_string(displays.size());
        display.info.width_mm = p.physicalDimensions.width;
        display.info.height_mm = p.physicalDimensions.height;
        read_modes(core, f, display);
        displays.push_back(std::move(display));
    }
    return displays;
}

std::string listed(const std::vector<Display>& displays) {
    std::string names;
    for (const Display& d : displays) names += (names.empty() ? "" : ", ") + d.info.name;
    return names;
}

// A plane that can show on the display: one that is free or already on it.
std::optional<std::uint32_t> find_plane(const Core& core, const Functions& f, VkDisplayKHR display,
                                        std::uint32_t& stack_index) {
    std::uint32_t count = 0;
    f.planes(core.physical, &count, nullptr);
    std::vector<VkDisplayPlanePropertiesKHR> planes(count);
    if (count == 0 || f.planes(core.physical, &count, planes.data()) < VK_SUCCESS) return std::nullopt;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (planes[i].currentDisplay != VK_NULL_HANDLE && planes[i].currentDisplay != display) continue;
        std::uint32_t shown = 0;
        f.plane_displays(core.physical, i, &shown, nullptr);
        std::vector<VkDisplayKHR> on(shown);
        if (shown == 0 || f.plane_displays(core.physical, i, &shown, on.data()) < VK_SUCCESS) continue;
        if (std::ranges::find(on, display) == on.end()) continue;
        stack_index = planes[i].currentStackIndex;
        return i;
    }
    return std::nullopt;
}

}  // namespace

const char* name_of(DisplayStereo stereo) {
    switch (stereo) {
        case DisplayStereo::none: return "none";
        case DisplayStereo::onboard_din: return "onboard_din";
        case DisplayStereo::hdmi_3d: return "hdmi_3d";
        case DisplayStereo::inband_displayport: return "inband_displayport";
    }
    return "?";
}

std::vector<std::string> direct_display_extensions() {
    return {VK_KHR_SURFACE_EXTENSION_NAME, VK_KHR_DISPLAY_EXTENSION_NAME,
            VK_KHR_GET_DISPLAY_PROPERTIES_2_EXTENSION_NAME};
}

std::vector<std::string> direct_display_optional_extensions() {
    return {VK_EXT_DISPLAY_SURFACE_COUNTER_EXTENSION_NAME, kStereoExtension};
}

int choose_mode(const std::vector<DisplayMode>& modes, const DisplayChoice& choice) {
    int best = -1;
    const auto worth = [&](const DisplayMode& m) {
        return choice.refresh_Hz > 0.0 ? -std::abs(m.refresh_Hz - choice.refresh_Hz) : m.refresh_Hz;
    };
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const bool right_size = (choice.width == 0 || modes[i].width == choice.width) &&
                                (choice.height == 0 || modes[i].height == choice.height);
        if (!right_size || (choice.stereo == DisplayStereo::hdmi_3d && !modes[i].hdmi_3d)) continue;
        if (best < 0 || worth(modes[i]) > worth(modes[static_cast<std::size_t>(best)])) best = static_cast<int>(i);
    }
    return best;
}

Result<std::vector<DisplayInfo>> list_displays(Device& device) {
    const auto displays = find_displays(*device.core(), Functions(device.core()->instance));
    if (!displays) return std::unexpected(displays.error());
    std::vector<DisplayInfo> infos;
    for (const Display& d : *displays) infos.push_back(d.info);
    return infos;
}

Result<SurfaceHandle> create_display_surface(Device& device, const DisplayChoice& choice) {
    const Core& core = *device.core();
    const Functions f(core.instance);
    const auto displays = find_displays(core, f);
    if (!displays) return std::unexpected(displays.error());
    if (choice.stereo != DisplayStereo::none && !core.capabilities.display_stereo) {
        return fail(kWhere, core.info.name + std::string(" offers no stereo (") + kStereoExtension + ")",
                    "update the graphics driver, or choose another output mode, such as side_by_side");
    }
    const auto display =
        std::ranges::find_if(*displays, [&](const Display& d) { return d.info.name.contains(choice.display); });
    if (display == displays->end()) {
        return fail(kWhere, "no display is called '" + choice.display + "'", "choose one of: " + listed(*displays));
    }
    DisplayChoice wanted = choice;
    if (wanted.width == 0) wanted.width = display->native.width;
    if (wanted.height == 0) wanted.height = display->native.height;
    const int mode = choose_mode(display->info.modes, wanted);
    if (mode < 0) {
        return fail(display->info.name,
                    "has no mode of " + std::to_string(wanted.width) + " x " + std::to_string(wanted.height) +
                        (choice.stereo == DisplayStereo::hdmi_3d ? " in HDMI 3D" : ""),
                    "choose a size that the display lists");
    }
    auto info = structure<VkDisplaySurfaceCreateInfoKHR>(VK_STRUCTURE_TYPE_DISPLAY_SURFACE_CREATE_INFO_KHR);
    const auto plane = find_plane(core, f, display->handle, info.planeStackIndex);
    if (!plane) return fail(display->info.name, "is taken by another program", "end the desktop or the program on it");
    DisplaySurfaceStereoCreateInfo stereo{kSurfaceStereoCreateInfo, nullptr, vulkan_type(choice.stereo)};
    if (choice.stereo != DisplayStereo::none) info.pNext = &stereo;
    const DisplayMode& chosen = display->info.modes[static_cast<std::size_t>(mode)];
    info.displayMode = display->mode_handles[static_cast<std::size_t>(mode)];
    info.planeIndex = *plane;
    info.transform = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR;
    info.globalAlpha = 1.0f;
    info.alphaMode = VK_DISPLAY_PLANE_ALPHA_OPAQUE_BIT_KHR;
    info.imageExtent = {chosen.width, chosen.height};
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (const VkResult r = f.create_surface(core.instance, &info, nullptr, &surface); r != VK_SUCCESS) {
        return vulkan_failure(display->info.name, "could not be opened", r);
    }
    return SurfaceHandle(device.core(), surface);
}

}  // namespace burin::gpu
