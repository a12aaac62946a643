// SPDX-License-Identifier: MIT
// Pictures made on the CPU - test patterns, tests - as the output stage takes them. Both functions wait for the GPU.
// Thread and lifetime: as gpu::Device.
#pragma once

#include <cstdint>

#include "gpu/image.hpp"
#include "renderer/image.hpp"

namespace burin {

// Two layers, left eye first, R8G8B8A8_SRGB, in layout SHADER_READ_ONLY_OPTIMAL. Both pictures are of one size.
[[nodiscard]] Result<gpu::Image> upload_eyes(gpu::Device& device, const Image& left, const Image& right);

// One layer; format R8G8B8A8_SRGB or R8G8B8A8_UNORM. For overlays.
[[nodiscard]] Result<gpu::Image> upload_image(gpu::Device& device, const Image& image, VkFormat format);

// What a layer of an image of 4 bytes a pixel and usage TRANSFER_SRC holds, as red, green, blue, alpha whatever its format
// is called. The image is in `layout` and is left in it.
[[nodiscard]] Result<Image> read_back(gpu::Device& device, VkImage image, ImageSize size, VkFormat format,
                                      VkImageLayout layout, std::uint32_t layer = 0);

}  // namespace burin
