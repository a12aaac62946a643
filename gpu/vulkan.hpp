// SPDX-License-Identifier: MIT
// Plain vulkan.h through volk: no prototypes, nothing linked, the loader is opened at run time. Device functions are
// called through their device's table (core.vk.vkCmdDispatch), so that one process may have several devices.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <volk.h>

#include <string>

#include "base/error.hpp"

namespace burin::gpu {

// Returns a Vulkan structure with its type set and all other members zero.
template <typename T>
[[nodiscard]] T structure(VkStructureType type) {
    T value{};
    value.sType = type;
    return value;
}

[[nodiscard]] std::string result_name(VkResult result);

// Returns the Error of a failed Vulkan call, with the remedy that fits the result.
[[nodiscard]] std::unexpected<Error> vulkan_failure(std::string where, std::string what, VkResult result);

}  // namespace burin::gpu
