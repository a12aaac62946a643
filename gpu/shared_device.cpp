// SPDX-License-Identifier: MIT
#include "gpu/shared_device.hpp"

namespace burin::gpu {

SharedDevice::~SharedDevice() {
    if (device != VK_NULL_HANDLE) {
        vk.vkDeviceWaitIdle(device);  // no lane is left, hence nobody uses a queue meanwhile
        vk.vkDestroyPipelineCache(device, pipeline_cache, nullptr);
        vk.vkDestroyDevice(device, nullptr);
    }
    if (messenger != VK_NULL_HANDLE) {
        const auto destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
        if (destroy_messenger != nullptr) destroy_messenger(instance, messenger, nullptr);
    }
    if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
}

Timeline::~Timeline() { device_->vk.vkDestroySemaphore(device_->device, semaphore, nullptr); }

}  // namespace burin::gpu
