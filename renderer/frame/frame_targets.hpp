// SPDX-License-Identifier: MIT
// The attachments of a frame, both eyes' pictures as two layers of one image, and the render passes that draw into
// them. A pass runs once and draws into both layers (multiview), or into one of them where only one view is shown.
// With several samples a pixel, shaders write linear light and the device resolves and encodes it. With one sample
// there is nothing to resolve, and shaders write sRGB values themselves (`encodes`): on a software driver that saves a
// third of the time of a pixel. Light that comes through glass adds up as linear light only, so glass has a pass of its
// own there, which sees the same picture in a format that the device decodes and encodes.
// Between frames the finished picture is in layout SHADER_READ_ONLY_OPTIMAL, ready to be sampled, or copied and read
// back to the host.
// Ownership: move-only. Thread: as gpu::Device.
#pragma once

#include "base/image.hpp"
#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"
#include "gpu/image.hpp"

namespace burin::renderer {

struct FrameTargets {
    static constexpr VkFormat kEncodedFormat = VK_FORMAT_R8G8B8A8_UNORM;
    static constexpr VkFormat kLinearFormat = VK_FORMAT_R8G8B8A8_SRGB;  // written and read as linear light
    static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

    ImageSize size;
    std::uint32_t samples = 1;
    Views views = Views::both;  // the views that the passes draw
    bool encodes = true;
    gpu::Image colour, depth;          // `samples` a pixel; colour exists only with several samples
    gpu::Image picture;                // the two finished views, one a layer
    gpu::ImageViewHandle both_eyes;    // of the picture, for sampling as linear light: an array of two layers
    gpu::RenderPassHandle whole_pass;  // discards the previous contents
    gpu::RenderPassHandle part_pass;   // keeps what lies outside the render area
    gpu::FramebufferHandle framebuffer;
    // Only with `encodes`: draws on top of what is there, blending linear light.
    gpu::RenderPassHandle glass_pass;
    gpu::FramebufferHandle glass_framebuffer;

    // samples is 1 or capabilities().msaa_samples.
    [[nodiscard]] static Result<FrameTargets> create(gpu::Device& device, ImageSize size, std::uint32_t samples,
                                                     Views views = Views::both);
};

// Returns the viewport of targets of this size, kGuard times as large.
[[nodiscard]] VkViewport viewport_of(ImageSize size);

// Reads both eyes' finished pictures back to the host.
class Readback {
public:
    // Allocates the buffer for pictures of this size; does nothing if it has this size already.
    [[nodiscard]] Result<void> fit(gpu::Device& device, ImageSize size);
    // Records the copy of an image of two layers of 4 bytes a
    // pixel, in layout SHADER_READ_ONLY_OPTIMAL before and after.
    void copy(const gpu::Device& device, gpu::Commands& commands, VkImage picture);
    // Returns the pictures; call it once the commands of copy() have finished.
    [[nodiscard]] StereoImage pictures() const;

private:
    gpu::Buffer buffer_;
    ImageSize size_;
};

}  // namespace burin::renderer
