// SPDX-License-Identifier: MIT
#include "gpu/instance.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/try.hpp"

namespace burin::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

std::atomic<std::uint64_t> g_validation_messages{0};  // a statistic; orders nothing

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    g_validation_messages.fetch_add(1, std::memory_order_relaxed);
    std::fprintf(stderr, "Vulkan validation: %s\n", data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info() {
    auto info = structure<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Leaves out GENERAL, with which the loader reports on other drivers of the machine.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = on_message;
    return info;
}

// The loader's entry points are the same for every instance, so they are loaded once; it is then safe to open devices
// on two threads at the same time.
std::mutex g_load_mutex;
VkInstance g_driver_keeper = VK_NULL_HANDLE, g_layer_keeper = VK_NULL_HANDLE;  // never destroyed

bool open_loader() {
    static const bool opened = volkInitialize() == VK_SUCCESS;
    return opened;
}

// Instances that live as long as the process keep the drivers and the validation layer loaded: loading them again for
// every device costs time, and Mesa 22.3.6 and the layer 1.3.239 leak some memory whenever they are unloaded.
void keep_loaded(VkInstance& keeper, VkInstance instance, std::span<const char* const> layers) {
    if (keeper != VK_NULL_HANDLE) return;
    auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    // If that fails, marks the keeper as made all the same; the caller still owns `instance`.
    if (vkCreateInstance(&info, nullptr, &keeper) != VK_SUCCESS) keeper = instance;
}

void load_instance_functions(VkInstance instance, bool validation) {
    const std::lock_guard lock(g_load_mutex);
    if (g_driver_keeper == VK_NULL_HANDLE) volkLoadInstanceOnly(instance);
    keep_loaded(g_driver_keeper, instance, {});
    if (validation) keep_loaded(g_layer_keeper, instance, {&kValidationLayer, 1});
}

bool validation_layer_installed() {
    std::uint32_t count = 0;
    if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkLayerProperties> layers(count);
    if (vkEnumerateInstanceLayerProperties(&count, layers.data()) < VK_SUCCESS) return false;
    return std::ranges::any_of(layers,
                               [](const auto& layer) { return std::string_view(layer.layerName) == kValidationLayer; });
}

std::vector<std::string> instance_extensions() {
    std::uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr) != VK_SUCCESS) return {};
    std::vector<VkExtensionProperties> found(count);
    if (vkEnumerateInstanceExtensionProperties(nullptr, &count, found.data()) < VK_SUCCESS) return {};
    std::vector<std::string> names;
    for (const auto& extension : found) names.emplace_back(extension.extensionName);
    return names;
}

bool has(const std::vector<std::string>& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

// Returns all required extensions and those of the optional ones that exist, each once.
Result<std::vector<std::string>> extensions_to_enable(const DeviceOptions& options) {
    std::vector<std::string> enabled = options.instance_extensions;
    if (enabled.empty() && options.optional_instance_extensions.empty()) return enabled;
    const std::vector<std::string> found = instance_extensions();
    for (const std::string& name : enabled) {
        if (!has(found, name)) {
            return fail("Vulkan", "the driver cannot show pictures here: it lacks " + name,
                        "install or update the graphics driver (mesa-vulkan-drivers)");
        }
    }
    for (const std::string& name : options.optional_instance_extensions) {
        if (has(found, name) && !has(enabled, name)) enabled.push_back(name);
    }
    return enabled;
}

template <typename Function>
void load(Function& function, VkInstance instance, const char* name) {
    function = reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

void load_surface_functions(SharedDevice& opened, const std::vector<std::string>& enabled) {
    if (has(enabled, VK_KHR_SURFACE_EXTENSION_NAME)) {
        load(opened.surface.destroy, opened.instance, "vkDestroySurfaceKHR");
        load(opened.surface.support, opened.instance, "vkGetPhysicalDeviceSurfaceSupportKHR");
        load(opened.surface.capabilities, opened.instance, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
        load(opened.surface.formats, opened.instance, "vkGetPhysicalDeviceSurfaceFormatsKHR");
    }
    opened.capabilities.display_stereo = has(enabled, "VK_NV_display_stereo");
    if (has(enabled, VK_EXT_DISPLAY_SURFACE_COUNTER_EXTENSION_NAME)) {
        load(opened.surface.counters, opened.instance, "vkGetPhysicalDeviceSurfaceCapabilities2EXT");
    }
}

}  // namespace

Result<void> create_instance(SharedDevice& opened, bool validation, const DeviceOptions& options) {
    if (!open_loader())
        return fail("Vulkan", "no Vulkan loader found", std::string("install libvulkan1 and ") + kNoDriver);
    if (volkGetInstanceVersion() < VK_API_VERSION_1_2) {
        return fail("Vulkan", "the loader is older than Vulkan 1.2", "update libvulkan1");
    }
    if (validation && !validation_layer_installed()) {
        return fail("Vulkan", "the validation layer is not installed",
                    "install vulkan-validationlayers or unset BURIN_VULKAN_VALIDATION");
    }
    auto app = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    app.pApplicationName = "burin";
    app.apiVersion = VK_API_VERSION_1_2;
    BURIN_TRY(extensions, extensions_to_enable(options));
    if (validation) {
        extensions.emplace_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.emplace_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    std::vector<const char*> names;
    for (const std::string& name : extensions) names.push_back(name.c_str());
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info();
    // Adds checks for missing barriers to the default checks.
    constexpr VkValidationFeatureEnableEXT kAlsoChecked = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    auto features = structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    features.pNext = &messenger;  // reports on creation and destruction of the instance itself
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &kAlsoChecked;
    auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &app;
    if (validation) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
    info.ppEnabledExtensionNames = names.data();
    const VkResult result = vkCreateInstance(&info, nullptr, &opened.instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return fail("Vulkan", "no Vulkan driver found", kNoDriver);
    if (result != VK_SUCCESS) return vulkan_failure("Vulkan", "the instance could not be created", result);
    load_instance_functions(opened.instance, validation);
    load_surface_functions(opened, extensions);
    if (validation) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(opened.instance, "vkCreateDebugUtilsMessengerEXT"));
        if (create == nullptr || create(opened.instance, &messenger, nullptr, &opened.messenger) != VK_SUCCESS) {
            return fail("Vulkan", "the validation layer reports to nobody", "update vulkan-validationlayers");
        }
    }
    return {};
}

std::uint64_t validation_messages() noexcept { return g_validation_messages.load(std::memory_order_relaxed); }

}  // namespace burin::gpu
