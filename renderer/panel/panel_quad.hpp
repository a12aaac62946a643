// SPDX-License-Identifier: MIT
// Draws a panel that stands in the scene into both eyes' pictures, with depth: what stands before it hides it, and it hides what is
// behind. For the inside of a pass with two views (FrameTargets' passes).
//
//   auto quad = PanelQuad::create(device, {pass, targets.samples, targets.encodes, false, pipelines.set_layout()});
//   quad->show(painter.view());                                 // and whenever the painter was resized
//   // within the pass, after what is solid and before what is glass, viewport and scissor set:
//   quad->record(commands.raw(), stand, pipelines.set());       // afterwards bind your own pipeline again
//
// The painter's record() comes before the pass begins. A panel seen from behind is seen through, mirrored, as on glass.
// Thread and lifetime: as gpu::Device. Cost: a draw of two triangles; four samples of the panel a pixel that it covers.
// No lamp lights it and no shadow falls on it. Where the panel is clear, what is behind is mixed in as linear light; with `encodes` that
// holds exactly over the scene's background colour, and nearly elsewhere.
#pragma once

#include <optional>

#include "gpu/commands.hpp"
#include "renderer/panel/panel_stand.hpp"
#include "renderer/panel/panel_vulkan.hpp"

namespace burin {

struct PanelQuadTarget {
    VkRenderPass pass = VK_NULL_HANDLE;  // one colour attachment and depth, two views
    std::uint32_t samples = 1;
    bool encodes = true;  // the colour attachment takes sRGB values as they are; false: it encodes linear light
    bool fades = false;   // parallax fades towards the screen's edges (shaders/shared/parallax_fade.h)
    VkDescriptorSetLayout frame = VK_NULL_HANDLE;  // of the set that holds FrameUniforms (Pipelines)
};

class PanelQuad {
public:
    [[nodiscard]] static Result<PanelQuad> create(gpu::Device& device, const PanelQuadTarget& target);

    // The picture to show: premultiplied sRGB values. In layout SHADER_READ_ONLY_OPTIMAL when the GPU gets to it.
    [[nodiscard]] Result<void> show(VkImageView panel);
    // Binds a pipeline of its own, the frame's set and a set behind it; nothing before the first show().
    void record(VkCommandBuffer commands, const PanelStand& stand, VkDescriptorSet frame) const;

private:
    explicit PanelQuad(const gpu::Device& device) : device_(device) {}

    gpu::Device device_;
    gpu::SamplerHandle sampler_;
    gpu::SetLayoutHandle set_layout_;
    gpu::PipelineLayoutHandle layout_;
    gpu::PipelineHandle pipeline_;
    std::uint32_t vertices_ = 0;
    std::optional<PictureSet> picture_;
};

}  // namespace burin
