// SPDX-License-Identifier: MIT
#include "gpu/device.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "base/try.hpp"
#include "gpu/core.hpp"
#include "gpu/instance.hpp"

namespace burin::gpu {

namespace {

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

Result<void> pick(SharedDevice& opened, const DeviceOptions& options) {
    BURIN_TRY(devices, physical_devices(opened.instance));
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
        } else if (opened.physical == VK_NULL_HANDLE ||
                   preference(info.kind, options.prefer) > preference(opened.info.kind, options.prefer)) {
            opened.physical = devices[i];
            opened.info = std::move(info);
        }
    }
    if (opened.physical == VK_NULL_HANDLE) {
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

void read_features(SharedDevice& opened, Features& enabled) {
    Features found;
    vkGetPhysicalDeviceFeatures2(opened.physical, &found.core);
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
    Capabilities& c = opened.capabilities;
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

void read_limits(SharedDevice& opened) {
    auto subgroup =
        structure<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
    auto v11 =
        structure<VkPhysicalDeviceMaintenance3Properties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
    auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &subgroup;
    subgroup.pNext = &v11;
    vkGetPhysicalDeviceProperties2(opened.physical, &properties);
    vkGetPhysicalDeviceMemoryProperties(opened.physical, &opened.memory);
    const VkPhysicalDeviceLimits& limits = properties.properties.limits;
    Capabilities& c = opened.capabilities;
    c.subgroup_size = subgroup.subgroupSize;
    c.max_storage_buffer_bytes = limits.maxStorageBufferRange;
    c.storage_offset_alignment = limits.minStorageBufferOffsetAlignment;
    c.max_push_constant_bytes = limits.maxPushConstantsSize;
    c.max_workgroup_invocations = limits.maxComputeWorkGroupInvocations;
    c.max_workgroup_count = *std::ranges::min_element(limits.maxComputeWorkGroupCount);
    c.max_image_size = limits.maxImageDimension2D;
    c.unified_memory = opened.info.kind == DeviceKind::software || opened.info.kind == DeviceKind::integrated;
    const VkSampleCountFlags samples = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    c.msaa_samples = (samples & VK_SAMPLE_COUNT_4_BIT) != 0 ? 4 : 1;
    opened.max_allocation_bytes = v11.maxMemoryAllocationSize;
    opened.queue_family = static_cast<std::uint32_t>(family_for_all(opened.physical));
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(opened.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(opened.physical, &count, families.data());
    c.timestamps = families[opened.queue_family].timestampValidBits > 0 && limits.timestampPeriod > 0;
    opened.queue_count =
        std::min(families[opened.queue_family].queueCount, static_cast<std::uint32_t>(opened.queues.size()));
    opened.seconds_per_stamp = static_cast<double>(limits.timestampPeriod) * 1e-9;
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

bool can_wait_for_presents(const SharedDevice& opened) {
    PresentFeatures found;
    auto features = structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    features.pNext = &found.id;
    vkGetPhysicalDeviceFeatures2(opened.physical, &features);
    return found.id.presentId == VK_TRUE && found.wait.presentWait == VK_TRUE;
}

std::vector<const char*> device_extensions(SharedDevice& opened) {
    std::vector<const char*> wanted;
    if (opened.surface.destroy == nullptr) return wanted;
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(opened.physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> found(count);
    vkEnumerateDeviceExtensionProperties(opened.physical, nullptr, &count, found.data());
    const auto exists = [&](std::string_view name) {
        return std::ranges::any_of(found, [name](const auto& e) { return e.extensionName == name; });
    };
    opened.capabilities.swapchain = exists(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (opened.capabilities.swapchain) wanted.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    opened.capabilities.display_control = opened.capabilities.swapchain && opened.surface.counters != nullptr &&
                                          exists(VK_EXT_DISPLAY_CONTROL_EXTENSION_NAME);
    if (opened.capabilities.display_control) wanted.push_back(VK_EXT_DISPLAY_CONTROL_EXTENSION_NAME);
    opened.capabilities.present_wait = opened.capabilities.swapchain && exists(VK_KHR_PRESENT_ID_EXTENSION_NAME) &&
                                       exists(VK_KHR_PRESENT_WAIT_EXTENSION_NAME) && can_wait_for_presents(opened);
    if (opened.capabilities.present_wait) {
        wanted.push_back(VK_KHR_PRESENT_ID_EXTENSION_NAME);
        wanted.push_back(VK_KHR_PRESENT_WAIT_EXTENSION_NAME);
    }
    return wanted;
}

Result<void> open(SharedDevice& opened) {
    read_limits(opened);
    Features features;
    read_features(opened, features);
    constexpr std::array<float, 2> kPriorities{1.0f, 1.0f};  // of opened.queues
    auto queue = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueFamilyIndex = opened.queue_family;
    queue.queueCount = opened.queue_count;
    queue.pQueuePriorities = kPriorities.data();
    auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &features.core;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    const std::vector<const char*> extensions = device_extensions(opened);
    PresentFeatures presents;
    presents.id.presentId = presents.wait.presentWait = VK_TRUE;
    if (opened.capabilities.present_wait) features.v12.pNext = &presents.id;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (const VkResult r = vkCreateDevice(opened.physical, &info, nullptr, &opened.device); r != VK_SUCCESS) {
        return vulkan_failure(opened.info.name, "the device could not be opened", r);
    }
    volkLoadDeviceTable(&opened.vk, opened.device);
    for (std::uint32_t i = 0; i < opened.queue_count; ++i)
        opened.vk.vkGetDeviceQueue(opened.device, opened.queue_family, i, &opened.queues[i].raw);
    const auto cache = structure<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    if (const VkResult r = opened.vk.vkCreatePipelineCache(opened.device, &cache, nullptr, &opened.pipeline_cache);
        r != VK_SUCCESS) {
        return vulkan_failure(opened.info.name, "no pipeline cache", r);
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
    SharedDevice none;
    BURIN_TRY_DO(create_instance(none, false));
    BURIN_TRY(devices, physical_devices(none.instance));
    std::vector<DeviceInfo> infos;
    for (unsigned i = 0; i < devices.size(); ++i) infos.push_back(describe(devices[i], i));
    return infos;
}

Result<Device> Device::create(const DeviceOptions& options) {
    auto opened = std::make_shared<SharedDevice>();
    auto done = create_instance(*opened, options.validation || validation_asked_by_environment(), options);
    if (done) done = pick(*opened, options);
    if (done) done = open(*opened);
    if (!done) return std::unexpected(done.error());
    DeviceQueue& first = opened->queues.front();
    BURIN_TRY(lane, Core::create(std::move(opened), first));
    return Device(std::move(lane));
}

Result<Device> Device::lane() const {
    BURIN_TRY(lane, core_->another_lane());
    return Device(std::move(lane));
}

const DeviceInfo& Device::info() const { return core_->info; }
const Capabilities& Device::capabilities() const { return core_->capabilities; }

WorkAsked Device::asked() const {
    return {core_->submitted,     core_->waits,          core_->bytes_to_device,
            core_->bytes_to_host, core_->most_own_bytes, core_->bytes_written_to_host};
}

std::uint64_t Device::memory_bytes() const { return core_->shared().own_bytes(); }

Result<void> Device::wait_idle() {
    auto done = core_->wait_for(core_->submitted);
    if (done) core_->collect();
    return done;
}

bool Device::lost() const { return core_->lost(); }

}  // namespace burin::gpu
