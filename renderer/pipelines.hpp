// SPDX-License-Identifier: MIT
// The renderer's pipelines, each compiled when it is first needed, and the descriptor set that they share.
// Ownership: move-only. Thread: as gpu::Device.
#pragma once

#include <array>

#include "gpu/buffer.hpp"
#include "renderer/frame_targets.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin {

enum class PipelineKind : std::size_t {
    shadow,       // depth only, for the light
    solid,        // the workpiece and the shapes
    backdrop,     // the room
    glass_back,   // the far faces of the workspace's boxes and bubble, then
    glass_front,  // their near ones; neither writes depth
    count
};

class Pipelines {
public:
    [[nodiscard]] static Result<Pipelines> create(gpu::Device& device, const FrameTargets& targets);

    [[nodiscard]] Result<VkPipeline> pipeline(gpu::Device& device, PipelineKind kind, const FrameTargets& targets);
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.raw(); }
    [[nodiscard]] VkDescriptorSet set() const { return set_; }
    // To be filled before submit(), when no frame is in flight.
    [[nodiscard]] shared::FrameUniforms& uniforms() { return uniforms_.mapped_as<shared::FrameUniforms>()[0]; }

private:
    [[nodiscard]] Result<void> create_samplers(gpu::Device& device);
    [[nodiscard]] Result<void> create_layouts(gpu::Device& device);
    [[nodiscard]] Result<void> create_set(gpu::Device& device, const FrameTargets& targets);

    gpu::Buffer uniforms_;
    gpu::SamplerHandle compare_sampler_, depth_sampler_;
    gpu::SetLayoutHandle set_layout_;
    gpu::PipelineLayoutHandle layout_;
    gpu::DescriptorPoolHandle pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;  // freed with its pool
    std::array<gpu::PipelineHandle, static_cast<std::size_t>(PipelineKind::count)> pipelines_;
};

}  // namespace burin
