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
    solid,     // the shapes, and the workpiece where it is lit at every pixel
    fine,      // the workpiece where it is lit at its vertices
    backdrop,  // the room
    backdrop_without_shadows,
    backdrop_plain,  // without shadows and grid
    glass_back,      // the far faces of the workspace's boxes and bubble, then
    glass_front,     // their near ones; neither writes depth
    count
};

class Pipelines {
public:
    [[nodiscard]] static Result<Pipelines> create(gpu::Device& device);

    // For the passes of these targets; the same number of samples each time, any views. fades: parallax, towards the screen's edges.
    [[nodiscard]] Result<VkPipeline> pipeline(gpu::Device& device, PipelineKind kind, bool fades,
                                              const FrameTargets& targets);
    [[nodiscard]] std::uint32_t created() const { return created_; }  // pipelines, so far
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.raw(); }
    [[nodiscard]] VkDescriptorSet set() const { return set_; }
    [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.raw(); }
    // For FrameUniforms; brought over with a frame's own commands, so that frames may follow one another unwaited for.
    [[nodiscard]] const gpu::Buffer& uniforms() const { return uniforms_; }

private:
    [[nodiscard]] Result<void> create_layouts(gpu::Device& device);
    [[nodiscard]] Result<void> create_set(gpu::Device& device);

    gpu::Buffer uniforms_;
    gpu::SetLayoutHandle set_layout_;
    gpu::PipelineLayoutHandle layout_;
    gpu::DescriptorPoolHandle pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;  // freed with its pool
    using OfEachKind = std::array<gpu::PipelineHandle, static_cast<std::size_t>(PipelineKind::count)>;
    std::array<std::array<OfEachKind, 2>, kViewChoices> pipelines_;  // by views, and by whether parallax fades
    std::uint32_t created_ = 0;
};

}  // namespace burin
