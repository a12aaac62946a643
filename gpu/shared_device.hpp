// SPDX-License-Identifier: MIT
// What all lanes of an opened device share (core.hpp): instance, VkDevice, queues, function table, what the device can
// do, whether it is lost, and how much of its memory is held.
//
// Vulkan lets several threads use one VkDevice, but for a few calls of which only one may run at a time. These are
// submitting to a queue, presenting to it and waiting for it, behind DeviceQueue's lock; and waiting for the whole
// device and destroying it, which happens after the last lane has gone.
// Threads: any. What has neither lock nor atomic is written while the device is opened, before there is a lane, and by
// tests that have the device to themselves.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "gpu/device.hpp"
#include "gpu/vulkan.hpp"

namespace burin::gpu {

// Functions of the instance extensions for windows; null where Device::create was not asked for them. They belong to
// the instance they were loaded from, hence they are kept here and not in volk's global variables.
struct SurfaceFunctions {
    PFN_vkDestroySurfaceKHR destroy = nullptr;
    PFN_vkGetPhysicalDeviceSurfaceSupportKHR support = nullptr;
    PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR capabilities = nullptr;
    PFN_vkGetPhysicalDeviceSurfaceFormatsKHR formats = nullptr;
    PFN_vkGetPhysicalDeviceSurfaceCapabilities2EXT counters = nullptr;  // also needs VK_EXT_display_control
};

// A queue of the device. Whoever calls with `raw` holds the lock.
struct DeviceQueue {
    VkQueue raw = VK_NULL_HANDLE;
    std::mutex mutex;
};

class SharedDevice {
public:
    SharedDevice() = default;
    ~SharedDevice();  // of what has been opened of it
    SharedDevice(const SharedDevice&) = delete;
    SharedDevice& operator=(const SharedDevice&) = delete;

    VkInstance instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    // Two where the family has as many, else one. The first is that of the device's first lane, the last that of all
    // others: what they submit then runs beside it.
    std::array<DeviceQueue, 2> queues;
    std::uint32_t queue_count = 1;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;  // Vulkan locks it
    VkPhysicalDeviceMemoryProperties memory{};
    std::uint64_t max_allocation_bytes = 0;
    double seconds_per_stamp = 0.0;
    VolkDeviceTable vk{};
    DeviceInfo info;
    Capabilities capabilities;
    SurfaceFunctions surface;

    // A flag alone, on the strength of which nothing else is read: no order is needed.
    [[nodiscard]] bool is_lost() const { return lost_.load(std::memory_order_relaxed); }
    void note_loss() { lost_.store(true, std::memory_order_relaxed); }
    // Of the device's own memory, held by all lanes. A sum, which orders nothing.
    [[nodiscard]] std::uint64_t own_bytes() const { return own_bytes_.load(std::memory_order_relaxed); }
    void note_allocated(std::uint64_t bytes) { own_bytes_.fetch_add(bytes, std::memory_order_relaxed); }
    void note_freed(std::uint64_t bytes) { own_bytes_.fetch_sub(bytes, std::memory_order_relaxed); }

private:
    std::atomic<bool> lost_ = false;
    std::atomic<std::uint64_t> own_bytes_ = 0;
};

// The timeline of a lane: its submissions signal one number after the other. Other lanes' submissions may wait for one
// of them and keep the timeline until they are done.
class Timeline {
public:
    explicit Timeline(std::shared_ptr<SharedDevice> device) : device_(std::move(device)) {}
    ~Timeline();
    Timeline(const Timeline&) = delete;
    Timeline& operator=(const Timeline&) = delete;

    VkSemaphore semaphore = VK_NULL_HANDLE;

private:
    std::shared_ptr<SharedDevice> device_;
};

}  // namespace burin::gpu
