// SPDX-License-Identifier: MIT
// Compute and graphics pipelines: shaders compiled for the device, with the state that stays the same.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "gpu/core.hpp"

namespace burin::gpu {

// A compute shader ready to dispatch. Its storage buffers are bindings 0 .. n-1 of set 0; it may have push constants.
// Cost: compilation takes 30-150 ms the first time with a software driver (1 ms from the driver's disk cache): create
// each pipeline once, when first needed.
struct ComputePipelineSpec {
    std::span<const std::uint32_t> spirv;  // read during create only
    std::uint32_t storage_buffers = 0;
    std::uint32_t push_constant_bytes = 0;          // a multiple of 4, at most capabilities().max_push_constant_bytes
    std::span<const std::uint32_t> constants = {};  // specialization constants: constant_id 0, 1, ...
    std::string name = "compute pipeline";          // for error messages
};

class ComputePipeline {
public:
    ComputePipeline() = default;
    [[nodiscard]] static Result<ComputePipeline> create(Device& device, const ComputePipelineSpec& spec);

    [[nodiscard]] VkPipeline raw() const { return pipeline_.raw(); }
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.raw(); }
    [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.raw(); }
    [[nodiscard]] std::uint32_t storage_buffers() const { return storage_buffers_; }
    [[nodiscard]] std::uint32_t push_constant_bytes() const { return push_constant_bytes_; }
    explicit operator bool() const { return static_cast<bool>(pipeline_); }

private:
    SetLayoutHandle set_layout_;
    PipelineLayoutHandle layout_;
    PipelineHandle pipeline_;
    std::uint32_t storage_buffers_ = 0;
    std::uint32_t push_constant_bytes_ = 0;
};

// A graphics pipeline for triangle lists with dynamic viewport and scissor; all other state is fixed by the spec. The
// default front face is counter-clockwise as the viewer sees it, given a projection that puts +Y up in the image.
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
