// SPDX-License-Identifier: MIT
// Plain vulkan.h through volk: no prototypes, nothing linked, the loader is opened at run time. Device functions are called
// through the table of their device (core.vk.vkCmdDispatch), so that several devices can live in one process.
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <volk.h>

#include <string>

#include "base/error.hpp"

namespace burin::gpu {

// A Vulkan structure with its type set and all else zero.
template <typename T>
[[nodiscard]] T structure(VkStructureType type) {
    T value{};
    value.sType = type;
    return value;
}

[[nodiscard]] std::string result_name(VkResult result);

// The Error of a failed Vulkan call, with the remedy that fits the result.
[[nodiscard]] std::unexpected<Error> vulkan_failure(std::string where, std::string what, VkResult result);

}  // namespace burin::gpu
