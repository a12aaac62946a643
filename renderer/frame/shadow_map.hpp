// SPDX-License-Identifier: MIT
// The shadow map: the depths of the objects that cast shadows, as the lamp sees them (picture/lamp_view.hpp).
// Drawn only when one of these objects has moved, come or gone; by a device's rasterizer, software or hardware.
// Between frames it is in a layout to be sampled. Ownership: move-only. Thread: that of the device.
#pragma once

#include <memory>
#include <vector>

#include "gpu/commands.hpp"
#include "gpu/image.hpp"
#include "picture/lamp_view.hpp"
#include "renderer/frame/mesh_store.hpp"

namespace burin::renderer {

class ShadowMap {
public:
    // `layout`: of pipelines whose push constants are DrawConstants.
    [[nodiscard]] static Result<ShadowMap> create(gpu::Device& device, VkPipelineLayout layout);

    // Draws the map where the objects are not those that it shows. `meshes` has those of the objects. Returns whether
    // it was drawn.
    [[nodiscard]] Result<bool> record(gpu::Device& device, gpu::Commands& commands, const picture::LampView& view,
                                      const MeshStore& meshes);

    // For descriptors: what compares depths, 1 where the reference is nearer to the lamp or beside the map; and what
    // reads them, 1 beside the map.
    [[nodiscard]] VkDescriptorImageInfo compared() const {
        return {compares_.raw(), depth_.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }
    [[nodiscard]] VkDescriptorImageInfo depths() const {
        return {reads_.raw(), depth_.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }

private:
    [[nodiscard]] Result<void> create_pass(gpu::Device& device);
    [[nodiscard]] Result<void> create_pipeline(gpu::Device& device);

    struct Shown {
        std::shared_ptr<const picture::DrawnMesh> mesh;
        Similarity world_from_mesh;
        bool operator==(const Shown&) const = default;
    };
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    gpu::Image depth_;
    gpu::RenderPassHandle pass_;
    gpu::FramebufferHandle framebuffer_;
    gpu::SamplerHandle compares_, reads_;
    gpu::PipelineHandle pipeline_;  // compiled at the first use
    std::vector<Shown> shown_;
};

}  // namespace burin::renderer
