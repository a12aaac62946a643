// SPDX-License-Identifier: MIT
// A compute shader ready to dispatch. Its storage buffers are bindings 0 .. n-1 of set 0; it may have push constants.
// Cost: compilation takes 30-150 ms the first time with a software driver (1 ms from the driver's disk cache): create
// each pipeline once, when first needed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "gpu/core.hpp"

namespace burin::gpu {

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

// Creates a shader module from SPIR-V words, for pipelines of any kind. It is not needed once the pipeline exists.
[[nodiscard]] Result<ShaderHandle> create_shader(Device& device, std::span<const std::uint32_t> spirv,
                                                 const std::string& name);

}  // namespace burin::gpu
