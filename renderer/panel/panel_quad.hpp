// SPDX-License-Identifier: MIT
// Draws a panel that stands in the scene into both eyes' pictures, with depth test: nearer objects hide it, and it
// hides farther ones. For use inside a pass with two views (FrameTargets' passes).
//
//   auto quad = PanelQuad::create(device, {pass, targets.samples, targets.encodes, false, pipelines.set_layout()});
//   quad->show(painter.view());                                 // and whenever the painter was resized
//   // within the pass, after what is solid and before what is glass, viewport and scissor set:
//   quad->record(commands.raw(), stand, pipelines.set());       // afterwards bind your own pipeline again
//
// The painter's record() comes before the pass begins. Seen from
// behind, the panel shows its picture mirrored, as on glass.
// Thread and lifetime: as gpu::Device. Cost: a draw of two triangles; four samples of the panel a pixel that it covers.
// The panel is not lit and receives no shadow. Where it is transparent, the scene behind is blended in linear light;
// with `encodes` that holds exactly over the scene's background colour, and approximately elsewhere.
#pragma once

#include <optional>

#include "gpu/commands.hpp"
#include "picture/panel_stand.hpp"
#include "renderer/panel/panel_vulkan.hpp"

namespace burin::renderer {

struct PanelQuadTarget {
    VkRenderPass pass = VK_NULL_HANDLE;  // one colour attachment and depth, two views
    std::uint32_t samples = 1;
    bool encodes = true;  // true: the colour attachment takes sRGB values as they are; false: it encodes linear light
    bool fades = false;   // parallax fades towards the screen's edges (shaders/shared/parallax_fade.h)
    VkDescriptorSetLayout frame = VK_NULL_HANDLE;  // layout of the set that holds FrameUniforms (Pipelines)
};

class PanelQuad {
public:
    [[nodiscard]] static Result<PanelQuad> create(gpu::Device& device, const PanelQuadTarget& target);

    // Sets the picture to show: premultiplied sRGB values, in layout SHADER_READ_ONLY_OPTIMAL when the GPU reads it.
    [[nodiscard]] Result<void> show(VkImageView panel);
    // Binds a pipeline of its own, the frame's set and its own set behind it. Does nothing before the first show().
    void record(VkCommandBuffer commands, const picture::PanelStand& stand, VkDescriptorSet frame) const;

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

}  // namespace burin::renderer
