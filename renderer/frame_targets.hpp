// SPDX-License-Identifier: MIT
// What a frame is drawn into: the shadow map, and both eyes' pictures as two layers, with the render passes that fill them.
// The second pass runs once and draws into both layers (multiview). Ownership: move-only. Thread: as gpu::Device.
#pragma once

#include "gpu/image.hpp"
#include "renderer/image.hpp"

namespace burin {

struct FrameTargets {
    static constexpr std::uint32_t kShadowTexels = 2048;
    static constexpr VkFormat kColourFormat = VK_FORMAT_R8G8B8A8_SRGB;  // shaders write linear light
    static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

    ImageSize size;
    std::uint32_t samples = 1;
    gpu::Image shadow_depth;
    gpu::Image colour, depth;  // `samples` a pixel
    gpu::Image picture;        // the two finished views; is `colour` resolved
    gpu::RenderPassHandle shadow_pass, view_pass;
    gpu::FramebufferHandle shadow_framebuffer, view_framebuffer;

    [[nodiscard]] static Result<FrameTargets> create(gpu::Device& device, ImageSize size);
};

}  // namespace burin
