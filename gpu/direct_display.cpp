// SPDX-License-Identifier: MIT
#include "gpu/direct_display.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace burin::gpu {

namespace {

constexpr const char* kStereoExtension = "VK_NV_display_stereo";
constexpr const char* kWhere = "direct display";
constexpr const char* kInAWindow = "show the picture in a window";

// VK_NV_display_stereo, declared by hand: the values of extension 552 begin at 1000551000.
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
    [[nodiscard]] bool complete() const {
        return displays && planes && plane_displays && modes && plane_capabilities && create_surface;
    }

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
    if (r < VK_SUCCESS) {
        auto failed = vulkan_failure(kWhere, core.info.name + " cannot list its displays", r);
        if (failed.error().remedy.empty()) failed.error().remedy = kInAWindow;
        return failed;
    }
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

std::vector<std::string> names_of(const std::vector<Display>& displays) {
    std::vector<std::string> names;
    for (const Display& d : displays) names.push_back(d.info.name);
    return names;
}

std::string in_words(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : ", ") + std::to_string(i) + " (" + names[i] + ")";
    return text;
}

struct Planes {
    std::vector<DisplayPlane> planes;
    std::vector<std::uint32_t> stack_indices;
};

// Returns the planes from the point of view of one display in one of its modes.
Planes planes_for(const Core& core, const Functions& f, VkDisplayKHR display, VkDisplayModeKHR mode) {
    std::uint32_t count = 0;
    f.planes(core.physical, &count, nullptr);
    std::vector<VkDisplayPlanePropertiesKHR> found(count);
    if (count == 0 || f.planes(core.physical, &count, found.data()) < VK_SUCCESS) return {};
    found.resize(count);
    Planes result;
    for (std::uint32_t i = 0; i < count; ++i) {
        DisplayPlane plane;
        plane.shows = found[i].currentDisplay == display;
        plane.taken = found[i].currentDisplay != VK_NULL_HANDLE && !plane.shows;
        std::uint32_t shown = 0;
        f.plane_displays(core.physical, i, &shown, nullptr);
        std::vector<VkDisplayKHR> on(shown);
        const bool told = shown > 0 && f.plane_displays(core.physical, i, &shown, on.data()) >= VK_SUCCESS;
        plane.reaches = told && std::ranges::find(on, display) != on.end();
        VkDisplayPlaneCapabilitiesKHR can{};
        if (plane.reaches && f.plane_capabilities(core.physical, mode, i, &can) == VK_SUCCESS) {
            plane.alpha = can.supportedAlpha;
            plane.most_width = can.maxDstExtent.width;
            plane.most_height = can.maxDstExtent.height;
        }
        result.planes.push_back(plane);
        result.stack_indices.push_back(found[i].currentStackIndex);
    }
    return result;
}

}  // namespace

std::vector<std::string> direct_display_extensions() {
    return {VK_KHR_SURFACE_EXTENSION_NAME, VK_KHR_DISPLAY_EXTENSION_NAME,
            VK_KHR_GET_DISPLAY_PROPERTIES_2_EXTENSION_NAME};
}

std::vector<std::string> direct_display_optional_extensions() {
    return {VK_EXT_DISPLAY_SURFACE_COUNTER_EXTENSION_NAME, kStereoExtension};
}

Result<std::vector<DisplayInfo>> list_displays(Device& device) {
    BURIN_TRY(displays, find_displays(*device.core(), Functions(device.core()->instance)));
    std::vector<DisplayInfo> infos;
    for (const Display& d : displays) infos.push_back(d.info);
    return infos;
}

Result<DisplaySurface> create_display_surface(Device& device, const DisplayChoice& choice) {
    const Core& core = *device.core();
    const Functions f(core.instance);
    BURIN_TRY(displays, find_displays(core, f));
    if (choice.stereo != DisplayStereo::none && !core.capabilities.display_stereo) {
        return fail(kWhere, core.info.name + std::string(" offers no stereo (") + kStereoExtension + ")",
                    "update the graphics driver, or choose another output mode, such as side_by_side");
    }
    const std::vector<std::string> names = names_of(displays);
    const int meant = choose_display(names, choice.display);
    if (meant < 0) {
        return fail(kWhere, "there is no display '" + choice.display + "'", "choose one of: " + in_words(names));
    }
    const Display& display = displays[static_cast<std::size_t>(meant)];
    DisplayChoice wanted = choice;
    if (wanted.width == 0) wanted.width = display.native.width;
    if (wanted.height == 0) wanted.height = display.native.height;
    const int mode = choose_mode(display.info.modes, wanted);
    if (mode < 0) {
        return fail("display " + display.info.name,
                    "it has no mode of " + std::to_string(wanted.width) + " x " + std::to_string(wanted.height) +
                        " pixels" + (choice.stereo == DisplayStereo::hdmi_3d ? " in HDMI 3D" : ""),
                    display.info.modes.empty() ? "switch it on, and plug it in again"
                                               : "choose one of: " + listed(display.info.modes));
    }
    const DisplayMode& chosen = display.info.modes[static_cast<std::size_t>(mode)];
    const VkDisplayModeKHR mode_handle = display.mode_handles[static_cast<std::size_t>(mode)];
    const Planes planes = planes_for(core, f, display.handle, mode_handle);
    const int plane = choose_plane(planes.planes, chosen.width, chosen.height);
    if (plane < 0) {
        return fail("display " + display.info.name, "it is taken by another program",
                    "end the desktop or the program on it");
    }
    const auto at = static_cast<std::size_t>(plane);
    auto info = structure<VkDisplaySurfaceCreateInfoKHR>(VK_STRUCTURE_TYPE_DISPLAY_SURFACE_CREATE_INFO_KHR);
    DisplaySurfaceStereoCreateInfo stereo{kSurfaceStereoCreateInfo, nullptr, vulkan_type(choice.stereo)};
    if (choice.stereo != DisplayStereo::none) info.pNext = &stereo;
    info.displayMode = mode_handle;
    info.planeIndex = static_cast<std::uint32_t>(plane);
    info.planeStackIndex = planes.stack_indices[at];
    info.transform = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR;
    info.globalAlpha = 1.0f;
    info.alphaMode = static_cast<VkDisplayPlaneAlphaFlagBitsKHR>(choose_alpha(planes.planes[at].alpha));
    info.imageExtent = {chosen.width, chosen.height};
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (const VkResult r = f.create_surface(core.instance, &info, nullptr, &surface); r != VK_SUCCESS) {
        auto failed = vulkan_failure("display " + display.info.name, "it could not be opened", r);
        if (failed.error().remedy.empty()) failed.error().remedy = kInAWindow;
        return failed;
    }
    return DisplaySurface{SurfaceHandle(device.core(), surface), display.info.name, chosen};
}

}  // namespace burin::gpu
