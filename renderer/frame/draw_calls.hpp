// SPDX-License-Identifier: MIT
// The calls that draw indexed triangles, while a pass is recorded: thin, and counted.
// Thread: that of the device. Lifetime: that of the commands.
#pragma once

#include <cstdint>

#include "base/image.hpp"
#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "renderer/frame/mesh_store.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin::renderer {

class DrawCalls {
public:
    DrawCalls(const gpu::Device& device, const gpu::Commands& commands, VkPipelineLayout layout)
        : vk_(&device.core()->vk), commands_(commands.raw()), layout_(layout) {}

    // Begins a pass over a part of targets of this size, with the descriptor set of all pipelines; `wanted` tells all
    // of the pass but its area.
    void begin(const VkRenderPassBeginInfo& wanted, const PixelRect& part, ImageSize size, VkDescriptorSet set) const;
    void use(VkPipeline pipeline) const;
    void bind(const gpu::Buffer& vertices, const gpu::Buffer& lights, const gpu::Buffer& indices) const;
    void bind(const MeshStore& meshes) const { bind(meshes.vertices(), meshes.lights(), meshes.indices()); }
    void clip(const PixelRect& part) const;
    void push(const shared::DrawConstants& constants) const;
    void draw(std::uint32_t index_count, std::uint32_t first_index, std::int32_t first_vertex = 0);
    void draw(const StoredMesh& mesh, const shared::DrawConstants& constants);

    [[nodiscard]] std::uint32_t draws() const { return draws_; }  // so far

private:
    const VolkDeviceTable* vk_;
    VkCommandBuffer commands_;
    VkPipelineLayout layout_;
    std::uint32_t draws_ = 0;
};

}  // namespace burin::renderer
