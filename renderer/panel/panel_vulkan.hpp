// SPDX-License-Identifier: MIT
// Vulkan objects shared by PanelPainter and PanelQuad: a picture that a fragment shader samples at set 0, binding 0.
// Thread and lifetime: as gpu::Device.
#pragma once

#include <span>

#include "gpu/image.hpp"
#include "renderer/panel/panel_mesh.hpp"

namespace burin::renderer {

// Uploads the atlas as an image of one byte a pixel, in layout SHADER_READ_ONLY_OPTIMAL. Waits for the GPU.
[[nodiscard]] Result<gpu::Image> upload_cover(gpu::Device& device, const PanelAtlas& atlas);

[[nodiscard]] Result<gpu::SamplerHandle> create_linear_sampler(gpu::Device& device);
[[nodiscard]] Result<gpu::SetLayoutHandle> create_picture_set_layout(gpu::Device& device);
[[nodiscard]] Result<gpu::PipelineLayoutHandle> create_push_layout(gpu::Device& device,
                                                                   std::span<const VkDescriptorSetLayout> set_layouts,
                                                                   VkShaderStageFlags stages, std::uint32_t size_bytes);

struct PictureSet {
    gpu::DescriptorPoolHandle pool;
    VkDescriptorSet set = VK_NULL_HANDLE;  // freed with its pool
};
[[nodiscard]] Result<PictureSet> create_picture_set(gpu::Device& device, const gpu::SetLayoutHandle& set_layout,
                                                    const gpu::SamplerHandle& sampler, VkImageView view);

}  // namespace burin::renderer
