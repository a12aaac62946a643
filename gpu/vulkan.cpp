// SPDX-License-Identifier: MIT
#define VOLK_IMPLEMENTATION
#include "gpu/vulkan.hpp"

namespace burin::gpu {

std::string result_name(VkResult result) {
    switch (result) {
        case VK_SUCCESS: return "success";
        case VK_NOT_READY: return "not ready";
        case VK_TIMEOUT: return "timeout";
        case VK_ERROR_OUT_OF_HOST_MEMORY: return "out of memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY: return "out of GPU memory";
        case VK_ERROR_INITIALIZATION_FAILED: return "initialisation failed";
        case VK_ERROR_DEVICE_LOST: return "device lost";
        case VK_ERROR_LAYER_NOT_PRESENT: return "layer not present";
        case VK_ERROR_EXTENSION_NOT_PRESENT: return "extension not present";
        case VK_ERROR_FEATURE_NOT_PRESENT: return "feature not present";
        case VK_ERROR_INCOMPATIBLE_DRIVER: return "incompatible driver";
        case VK_ERROR_TOO_MANY_OBJECTS: return "too many objects";
        case VK_ERROR_FORMAT_NOT_SUPPORTED: return "format not supported";
        case VK_ERROR_FRAGMENTED_POOL: return "fragmented pool";
        case VK_ERROR_OUT_OF_POOL_MEMORY: return "out of pool memory";
        case VK_ERROR_SURFACE_LOST_KHR: return "surface lost";
        case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR: return "window already in use";
        case VK_ERROR_OUT_OF_DATE_KHR: return "out of date";
        case VK_ERROR_UNKNOWN: return "an error that the driver does not name";
        default: return "VkResult " + std::to_string(static_cast<int>(result));
    }
}

std::unexpected<Error> vulkan_failure(std::string where, std::string what, VkResult result) {
    std::string remedy;
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
        remedy = "lower the resolution or close other programs that use the GPU";
    } else if (result == VK_ERROR_DEVICE_LOST) {
        remedy = "start again; if it repeats, update the GPU driver";
    }
    return fail(std::move(where), std::move(what) + ": " + result_name(result), std::move(remedy));
}

}  // namespace burin::gpu
