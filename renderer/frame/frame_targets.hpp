// SPDX-License-Identifier: MIT
// What a frame is drawn into: both eyes' pictures as two layers of one image, and the render passes that fill them. A pass runs once and
// draws into both layers (multiview), or into one of them where the other is never looked at.
// With several samples a pixel, shaders write linear light and the device mixes and encodes it. With one sample nothing is mixed, and shaders
// write sRGB values themselves (`encodes`): on a software driver that saves a third of the time of a pixel.
// The finished picture lies in layout SHADER_READ_ONLY_OPTIMAL between frames, for whoever shows it or copies it.
// Ownership: move-only. Thread: as gpu::Device.
#pragma once

#include "gpu/image.hpp"
#include "renderer/image.hpp"

namespace burin {

struct FrameTargets {
    static constexpr VkFormat kEncodedFormat = VK_FORMAT_R8G8B8A8_UNORM;
    static constexpr VkFormat kLinearFormat = VK_FORMAT_R8G8B8A8_SRGB;  // linear light goes in and comes out
    static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

    ImageSize size;
    std::uint32_t samples = 1;
    Views views = Views::both;  // drawn by the passes
    bool encodes = true;
    gpu::Image colour, depth;          // `samples` a pixel; colour only when there are several
    gpu::Image picture;                // the two finished views
    gpu::ImageViewHandle both_eyes;    // of the picture, as linear light, for sampling: an array of two layers
    gpu::RenderPassHandle whole_pass;  // whatever was there before goes
    gpu::RenderPassHandle part_pass;   // what lies outside the render area stays
    gpu::FramebufferHandle framebuffer;

    // samples: 1 or capabilities().msaa_samples.
    [[nodiscard]] static Result<FrameTargets> create(gpu::Device& device, ImageSize size, std::uint32_t samples,
                                                     Views views = Views::both);
};

}  // namespace burin
