// SPDX-License-Identifier: MIT
#include "renderer/frame/draw_calls.hpp"

#include <array>

#include "renderer/frame/frame_targets.hpp"

namespace burin::renderer {

void DrawCalls::begin(const VkRenderPassBeginInfo& wanted, const PixelRect& part, ImageSize size,
                      VkDescriptorSet set) const {
    VkRenderPassBeginInfo info = wanted;
    info.renderArea = {{static_cast<std::int32_t>(part.x), static_cast<std::int32_t>(part.y)},
                       {part.width, part.height}};
    vk_->vkCmdBeginRenderPass(commands_, &info, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport = viewport_of(size);
    vk_->vkCmdSetViewport(commands_, 0, 1, &viewport);
    vk_->vkCmdSetScissor(commands_, 0, 1, &info.renderArea);
    vk_->vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0, nullptr);
}

void DrawCalls::use(VkPipeline pipeline) const {
    vk_->vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
}

void DrawCalls::bind(const gpu::Buffer& vertices, const gpu::Buffer& lights, const gpu::Buffer& indices) const {
    const std::array<VkBuffer, 2> buffers{vertices.raw(), lights.raw()};
    const std::array<VkDeviceSize, 2> offsets{0, 0};
    vk_->vkCmdBindVertexBuffers(commands_, 0, 2, buffers.data(), offsets.data());
    vk_->vkCmdBindIndexBuffer(commands_, indices.raw(), 0, VK_INDEX_TYPE_UINT32);
}

void DrawCalls::clip(const PixelRect& part) const {
    const VkRect2D scissor{{static_cast<std::int32_t>(part.x), static_cast<std::int32_t>(part.y)},
                           {part.width, part.height}};
    vk_->vkCmdSetScissor(commands_, 0, 1, &scissor);
}

void DrawCalls::push(const shared::DrawConstants& constants) const {
    vk_->vkCmdPushConstants(commands_, layout_, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                            sizeof(constants), &constants);
}

void DrawCalls::draw(std::uint32_t index_count, std::uint32_t first_index, std::int32_t first_vertex) {
    vk_->vkCmdDrawIndexed(commands_, index_count, 1, first_index, first_vertex, 0);
    ++draws_;
}

void DrawCalls::draw(const StoredMesh& mesh, const shared::DrawConstants& constants) {
    push(constants);
    draw(mesh.index_count, mesh.first_index, mesh.first_vertex);
}

}  // namespace burin::renderer
