// SPDX-License-Identifier: MIT
#include "renderer/panel/panel_quad.hpp"

#include <array>

#include "base/try.hpp"
#include "gpu/pipelines.hpp"
#include "shaders/panel_quad.frag.spv.hpp"
#include "shaders/panel_quad.vert.spv.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin::renderer {
namespace {

// The same stages as in the renderer's other pipelines, so that the frame's set stays bound from one to the next.
constexpr VkShaderStageFlags kPushStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

Mat4 world_from_local(const picture::PanelStand& stand) {
    Mat4 m = matrix(Similarity{stand.world_from_panel.position_m, stand.world_from_panel.orientation, 1.0});
    m[0] *= stand.size_m.x;
    m[1] *= stand.size_m.y;
    return m;
}

}  // namespace

Result<PanelQuad> PanelQuad::create(gpu::Device& device, const PanelQuadTarget& target) {
    PanelQuad quad(device);
    BURIN_TRY(sampler, create_linear_sampler(device));
    quad.sampler_ = std::move(sampler);
    BURIN_TRY(set_layout, create_picture_set_layout(device));
    quad.set_layout_ = std::move(set_layout);
    const std::array set_layouts{target.frame, quad.set_layout_.raw()};
    BURIN_TRY(layout, create_push_layout(device, set_layouts, kPushStages, sizeof(shared::DrawConstants)));
    quad.layout_ = std::move(layout);
    const std::array<std::uint32_t, 2> constants{target.encodes ? 1u : 0u, target.fades ? 1u : 0u};
    quad.vertices_ = target.fades ? 6 * shared::kFadedPanelCells * shared::kFadedPanelCells : 6;
    gpu::GraphicsPipelineSpec spec;
    spec.vertex_spirv = k_panel_quad_vert;
    spec.fragment_spirv = k_panel_quad_frag;
    spec.render_pass = target.pass;
    spec.layout = quad.layout_.raw();
    spec.samples = target.samples;
    spec.constants = constants;
    spec.blend = true;
    spec.name = "standing panel pipeline";
    BURIN_TRY(pipeline, gpu::create_graphics_pipeline(device, spec));
    quad.pipeline_ = std::move(pipeline);
    return quad;
}

Result<void> PanelQuad::show(VkImageView panel) {
    BURIN_TRY(made, create_picture_set(device_, set_layout_, sampler_, panel));
    picture_ = std::move(made);
    return {};
}

void PanelQuad::record(VkCommandBuffer commands, const picture::PanelStand& stand, VkDescriptorSet frame) const {
    if (!picture_) return;
    shared::DrawConstants constants{};
    constants.world_from_local = glm::mat4(world_from_local(stand));
    const std::array sets{frame, picture_->set};
    const VolkDeviceTable& vk = device_.core()->vk;
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.raw());
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.raw(), 0, 2, sets.data(), 0, nullptr);
    vk.vkCmdPushConstants(commands, layout_.raw(), kPushStages, 0, sizeof(constants), &constants);
    vk.vkCmdDraw(commands, vertices_, 1, 0, 0);
}

}  // namespace burin::renderer
