// SPDX-License-Identifier: MIT
// A graphics pipeline for triangle lists with dynamic viewport and scissor; all other state is fixed by the spec. The
// default front face is counter-clockwise as the viewer sees it, given a projection that puts +Y up in the image.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "gpu/core.hpp"

namespace burin::gpu {

struct GraphicsPipelineSpec {
    std::span<const std::uint32_t> vertex_spirv;
    std::span<const std::uint32_t> fragment_spirv;  // empty: depth only
    VkRenderPass render_pass = VK_NULL_HANDLE;      // subpass 0
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::span<const VkVertexInputBindingDescription> bindings;
    std::span<const VkVertexInputAttributeDescription> attributes;
    std::span<const std::uint32_t> constants;  // specialization constants of both stages: constant_id 0, 1, ...
    std::uint32_t samples = 1;
    std::uint32_t color_attachments = 1;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkFrontFace front = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    bool depth_test = true;
    bool depth_write = true;
    bool blend = false;                      // premultiplied alpha
    std::string name = "graphics pipeline";  // for error messages
};

[[nodiscard]] Result<PipelineHandle> create_graphics_pipeline(Device& device, const GraphicsPipelineSpec& spec);

}  // namespace burin::gpu
