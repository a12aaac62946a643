// SPDX-License-Identifier: MIT
// Uploads pictures made on the CPU (test patterns, tests) in the form that the output stage takes, and reads images
// back. All functions wait for the GPU.
// Thread and lifetime: as gpu::Device.
#pragma once

#include <cstdint>

#include "base/image.hpp"
#include "gpu/image.hpp"

namespace burin::renderer {

// Returns an image of two layers, left eye first, R8G8B8A8_SRGB, in
// layout SHADER_READ_ONLY_OPTIMAL. Both pictures have the same size.
[[nodiscard]] Result<gpu::Image> upload_eyes(gpu::Device& device, const Image& left, const Image& right);

// Returns an image of one layer, for overlays; format is R8G8B8A8_SRGB or R8G8B8A8_UNORM.
[[nodiscard]] Result<gpu::Image> upload_image(gpu::Device& device, const Image& image, VkFormat format);

// Reads back a layer of an image of 4 bytes a pixel and usage TRANSFER_SRC, as red, green, blue, alpha in this order
// whatever the order of `format`. The image is in `layout` and is left in it.
[[nodiscard]] Result<Image> read_back(gpu::Device& device, VkImage image, ImageSize size, VkFormat format,
                                      VkImageLayout layout, std::uint32_t layer = 0);

}  // namespace burin::renderer
