// SPDX-License-Identifier: MIT
#include "gpu/device.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <span>
#include <string_view>

#include "base/try.hpp"
#include "gpu/core.hpp"

namespace burin::gpu {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoDriver = "install mesa-vulkan-drivers";

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

void load_surface_functions(Core& core, const std::vector<std::string>& enabled) {
    if (has(enabled, VK_KHR_SURFACE_EXTENSION_NAME)) {
        load(core.surface.destroy, core.instance, "vkDestroySurfaceKHR");
        load(core.surface.support, core.instance, "vkGetPhysicalDeviceSurfaceSupportKHR");
        load(core.surface.capabilities, core.instance, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
        load(core.surface.formats, core.instance, "vkGetPhysicalDeviceSurfaceFormatsKHR");
    }
    core.capabilities.display_stereo = has(enabled, "VK_NV_display_stereo");
    if (has(enabled, VK_EXT_DISPLAY_SURFACE_COUNTER_EXTENSION_NAME)) {
        load(core.surface.counters, core.instance, "vkGetPhysicalDeviceSurfaceCapabilities2EXT");
    }
}

Result<void> create_instance(Core& core, bool validation, const DeviceOptions& options = {}) {
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
    const VkResult result = vkCreateInstance(&info, nullptr, &core.instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return fail("Vulkan", "no Vulkan driver found", kNoDriver);
    if (result != VK_SUCCESS) return vulkan_failure("Vulkan", "the instance could not be created", result);
    load_instance_functions(core.instance, validation);
    load_surface_functions(core, extensions);
    if (validation) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(core.instance, "vkCreateDebugUtilsMessengerEXT"));
        if (create == nullptr || create(core.instance, &messenger, nullptr, &core.messenger) != VK_SUCCESS) {
            return fail("Vulkan", "the validation layer reports to nobody", "update vulkan-validationlayers");
        }
    }
    return {};
}

std::string version_text(std::uint32_t v) {
    return std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)) + "." +
           std::to_string(VK_API_VERSION_PATCH(v));
}

DeviceKind kind_of(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return DeviceKind::discrete;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return DeviceKind::integrated;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return DeviceKind::virtual_machine;
        case VK_PHYSICAL_DEVICE_TYPE_CPU: return DeviceKind::software;
        default: return DeviceKind::other;
    }
}

// Returns a queue family for graphics and compute, as every desktop driver has; -1 when there is none.
int family_for_all(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    constexpr VkQueueFlags kAll = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & kAll) == kAll) return static_cast<int>(i);
    }
    return -1;
}

DeviceInfo describe(VkPhysicalDevice physical, unsigned index) {
    auto driver = structure<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    vkGetPhysicalDeviceProperties(physical, &properties.properties);
    const bool recent = properties.properties.apiVersion >= VK_API_VERSION_1_2;
    if (recent) {
        properties.pNext = &driver;
        vkGetPhysicalDeviceProperties2(physical, &properties);
    }
    DeviceInfo info;
    info.index = index;
    info.name = properties.properties.deviceName;
    info.kind = kind_of(properties.properties.deviceType);
    info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    info.api = version_text(properties.properties.apiVersion);
    if (!recent) {
        info.unusable = "older than Vulkan 1.2";
    } else if (family_for_all(physical) < 0) {
        info.unusable = "has no queue for both graphics and compute";
    }
    return info;
}

Result<std::vector<VkPhysicalDevice>> physical_devices(VkInstance instance) {
    std::uint32_t count = 0;
    VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    if (result == VK_SUCCESS && count > 0) result = vkEnumeratePhysicalDevices(instance, &count, devices.data());
    if (result == VK_ERROR_INITIALIZATION_FAILED || result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        return fail("Vulkan", "no Vulkan driver found", kNoDriver);
    }
    if (result < VK_SUCCESS) return vulkan_failure("Vulkan", "the devices could not be listed", result);
    devices.resize(count);
    return devices;
}

int preference(DeviceKind kind, Prefer prefer) {
    const int hardware_rank = [kind] {
        switch (kind) {
            case DeviceKind::discrete: return 4;
            case DeviceKind::integrated: return 3;
            case DeviceKind::virtual_machine: return 2;
            case DeviceKind::other: return 1;
            case DeviceKind::software: return 0;
        }
        return 0;
    }();
    return prefer == Prefer::hardware || kind != DeviceKind::software ? hardware_rank : 5;
}

Result<void> pick(Core& core, const DeviceOptions& options) {
    BURIN_TRY(devices, physical_devices(core.instance));
    if (devices.empty()) return fail("Vulkan", "no Vulkan driver found", kNoDriver);
    if (options.index && *options.index >= devices.size()) {
        return fail("Vulkan", "there is no device " + std::to_string(*options.index),
                    "choose one of 0 to " + std::to_string(devices.size() - 1) + ", see burin --version");
    }
    std::string reasons;
    for (unsigned i = 0; i < devices.size(); ++i) {
        if (options.index && *options.index != i) continue;
        DeviceInfo info = describe(devices[i], i);
        if (!info.unusable.empty()) {
            reasons += (reasons.empty() ? "" : ", ") + info.name + " " + info.unusable;
        } else if (core.physical == VK_NULL_HANDLE ||
                   preference(info.kind, options.prefer) > preference(core.info.kind, options.prefer)) {
            core.physical = devices[i];
            core.info = std::move(info);
        }
    }
    if (core.physical == VK_NULL_HANDLE) {
        return fail("Vulkan", "no usable device: " + reasons, std::string("update the driver, or ") + kNoDriver);
    }
    return {};
}

// The features that are enabled wherever they exist.
struct Features {
    VkPhysicalDeviceFeatures2 core = structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    VkPhysicalDeviceVulkan11Features v11 =
        structure<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
    VkPhysicalDeviceVulkan12Features v12 =
        structure<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);

    Features() {
        core.pNext = &v11;
        v11.pNext = &v12;
    }
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;
};

void read_features(Core& core, Features& enabled) {
    Features found;
    vkGetPhysicalDeviceFeatures2(core.physical, &found.core);
    const VkPhysicalDeviceFeatures& f = found.core.features;
    enabled.core.features.shaderInt64 = f.shaderInt64;
    enabled.core.features.shaderFloat64 = f.shaderFloat64;
    enabled.core.features.shaderInt16 = f.shaderInt16;
    enabled.core.features.samplerAnisotropy = f.samplerAnisotropy;
    enabled.v11.multiview = VK_TRUE;  // required of every Vulkan 1.1 device
    enabled.v11.storageBuffer16BitAccess = found.v11.storageBuffer16BitAccess;
    enabled.v12.timelineSemaphore = VK_TRUE;  // required of every Vulkan 1.2 device
    enabled.v12.shaderInt8 = found.v12.shaderInt8;
    enabled.v12.storageBuffer8BitAccess = found.v12.storageBuffer8BitAccess;
    enabled.v12.shaderBufferInt64Atomics = found.v12.shaderBufferInt64Atomics;
    enabled.v12.scalarBlockLayout = found.v12.scalarBlockLayout;
    enabled.v12.bufferDeviceAddress = found.v12.bufferDeviceAddress;
    Capabilities& c = core.capabilities;
    c.shader_int64 = f.shaderInt64 == VK_TRUE;
    c.shader_float64 = f.shaderFloat64 == VK_TRUE;
    c.shader_int16 = f.shaderInt16 == VK_TRUE;
    c.sampler_anisotropy = f.samplerAnisotropy == VK_TRUE;
    c.storage_16bit = found.v11.storageBuffer16BitAccess == VK_TRUE;
    c.shader_int8 = found.v12.shaderInt8 == VK_TRUE;
    c.storage_8bit = found.v12.storageBuffer8BitAccess == VK_TRUE;
    c.buffer_int64_atomics = found.v12.shaderBufferInt64Atomics == VK_TRUE;
    c.scalar_block_layout = found.v12.scalarBlockLayout == VK_TRUE;
    c.buffer_address = found.v12.bufferDeviceAddress == VK_TRUE;
}

void read_limits(Core& core) {
    auto subgroup =
        structure<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
    auto v11 =
        structure<VkPhysicalDeviceMaintenance3Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
    auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &subgroup;
    subgroup.pNext = &v11;
    vkGetPhysicalDeviceProperties2(core.physical, &properties);
    vkGetPhysicalDeviceMemoryProperties(core.physical, &core.memory);
    const VkPhysicalDeviceLimits& limits = properties.properties.limits;
    Capabilities& c = core.capabilities;
    c.subgroup_size = subgroup.subgroupSize;
    c.max_storage_buffer_bytes = limits.maxStorageBufferRange;
    c.storage_offset_alignment = limits.minStorageBufferOffsetAlignment;
    c.max_push_constant_bytes = limits.maxPushConstantsSize;
    c.max_workgroup_invocations = limits.maxComputeWorkGroupInvocations;
    c.max_workgroup_count = *std::ranges::min_element(limits.maxComputeWorkGroupCount);
    c.max_image_size = limits.maxImageDimension2D;
    c.unified_memory = core.info.kind == DeviceKind::software || core.info.kind == DeviceKind::integrated;
    const VkSampleCountFlags samples = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    c.msaa_samples = (samples & VK_SAMPLE_COUNT_4_BIT) != 0 ? 4 : 1;
    core.max_allocation_bytes = v11.maxMemoryAllocationSize;
    core.queue_family = static_cast<std::uint32_t>(family_for_all(core.physical));
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(core.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(core.physical, &count, families.data());
    c.timestamps = families[core.queue_family].timestampValidBits > 0 && limits.timestampPeriod > 0;
    core.seconds_per_stamp = static_cast<double>(limits.timestampPeriod) * 1e-9;
}

// The features for waiting for presentations; enabled where both exist.
struct PresentFeatures {
    VkPhysicalDevicePresentIdFeaturesKHR id =
        structure<VkPhysicalDevicePresentIdFeaturesKHR>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRESENT_ID_FEATURES_KHR);
    VkPhysicalDevicePresentWaitFeaturesKHR wait =
        structure<VkPhysicalDevicePresentWaitFeaturesKHR>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRESENT_WAIT_FEATURES_KHR);

    PresentFeatures() { id.pNext = &wait; }
    PresentFeatures(const PresentFeatures&) = delete;
    PresentFeatures& operator=(const PresentFeatures&) = delete;
};

bool can_wait_for_presents(const Core& core) {
    PresentFeatures found;
    auto features = structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    features.pNext = &found.id;
    vkGetPhysicalDeviceFeatures2(core.physical, &features);
    return found.id.presentId == VK_TRUE && found.wait.presentWait == VK_TRUE;
}

std::vector<const char*> device_extensions(Core& core) {
    std::vector<const char*> wanted;
    if (core.surface.destroy == nullptr) return wanted;
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(core.physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> found(count);
    vkEnumerateDeviceExtensionProperties(core.physical, nullptr, &count, found.data());
    const auto exists = [&](std::string_view name) {
        return std::ranges::any_of(found, [name](const auto& e) { return e.extensionName == name; });
    };
    core.capabilities.swapchain = exists(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (core.capabilities.swapchain) wanted.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    core.capabilities.display_control = core.capabilities.swapchain && core.surface.counters != nullptr &&
                                        exists(VK_EXT_DISPLAY_CONTROL_EXTENSION_NAME);
    if (core.capabilities.display_control) wanted.push_back(VK_EXT_DISPLAY_CONTROL_EXTENSION_NAME);
    core.capabilities.present_wait = core.capabilities.swapchain && exists(VK_KHR_PRESENT_ID_EXTENSION_NAME) &&
                                     exists(VK_KHR_PRESENT_WAIT_EXTENSION_NAME) && can_wait_for_presents(core);
    if (core.capabilities.present_wait) {
        wanted.push_back(VK_KHR_PRESENT_ID_EXTENSION_NAME);
        wanted.push_back(VK_KHR_PRESENT_WAIT_EXTENSION_NAME);
    }
    return wanted;
}

Result<void> open(Core& core) {
    read_limits(core);
    Features features;
    read_features(core, features);
    const float priority = 1.0f;
    auto queue = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = core.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &features.core;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    const std::vector<const char*> extensions = device_extensions(core);
    PresentFeatures presents;
    presents.id.presentId = presents.wait.presentWait = VK_TRUE;
    if (core.capabilities.present_wait) features.v12.pNext = &presents.id;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (const VkResult r = vkCreateDevice(core.physical, &info, nullptr, &core.device); r != VK_SUCCESS) {
        return vulkan_failure(core.info.name, "the device could not be opened", r);
    }
    volkLoadDeviceTable(&core.vk, core.device);
    core.vk.vkGetDeviceQueue(core.device, core.queue_family, 0, &core.queue);
    auto type = structure<VkSemaphoreTypeCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO);
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    auto semaphore = structure<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    semaphore.pNext = &type;
    if (const VkResult r = core.vk.vkCreateSemaphore(core.device, &semaphore, nullptr, &core.timeline);
        r != VK_SUCCESS) {
        return vulkan_failure(core.info.name, "no timeline semaphore", r);
    }
    const auto cache = structure<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    if (const VkResult r = core.vk.vkCreatePipelineCache(core.device, &cache, nullptr, &core.pipeline_cache);
        r != VK_SUCCESS) {
        return vulkan_failure(core.info.name, "no pipeline cache", r);
    }
    return {};
}

bool validation_asked_by_environment() {
    const char* value = std::getenv("BURIN_VULKAN_VALIDATION");
    return value != nullptr && std::string_view(value) == "1";
}

}  // namespace

std::string DeviceInfo::line() const {
    constexpr std::array<const char*, 5> kKinds{"discrete", "integrated", "virtual machine", "software", "other"};
    std::string text = std::to_string(index) + ": " + name + " (" + kKinds[static_cast<std::size_t>(kind)] + ", " +
                       driver + ", Vulkan " + api + ")";
    if (!unusable.empty()) text += ", cannot be used: " + unusable;
    return text;
}

Result<std::vector<DeviceInfo>> list_devices() {
    Core core;
    BURIN_TRY_DO(create_instance(core, false));
    BURIN_TRY(devices, physical_devices(core.instance));
    std::vector<DeviceInfo> infos;
    for (unsigned i = 0; i < devices.size(); ++i) infos.push_back(describe(devices[i], i));
    return infos;
}

Result<Device> Device::create(const DeviceOptions& options) {
    auto core = std::make_shared<Core>();
    auto done = create_instance(*core, options.validation || validation_asked_by_environment(), options);
    if (done) done = pick(*core, options);
    if (done) done = open(*core);
    if (!done) return std::unexpected(done.error());
    return Device(std::move(core));
}

const DeviceInfo& Device::info() const { return core_->info; }
const Capabilities& Device::capabilities() const { return core_->capabilities; }

WorkAsked Device::asked() const {
    return {core_->submitted, core_->waits, core_->bytes_to_device, core_->bytes_to_host, core_->most_own_bytes};
}

Result<void> Device::wait_idle() {
    auto done = core_->wait_for(core_->submitted);
    if (done) core_->collect();
    return done;
}

bool Device::lost() const { return core_->lost; }

std::uint64_t validation_messages() noexcept { return g_validation_messages.load(std::memory_order_relaxed); }

}  // namespace burin::gpu
