// SPDX-License-Identifier: MIT
// The renderer's pipelines, each compiled at its first use, and the descriptor set that they share.
// Ownership: move-only. Thread: as gpu::Device.
#pragma once

#include <array>

#include "gpu/buffer.hpp"
#include "renderer/frame/frame_targets.hpp"
#include "renderer/frame/shadow_map.hpp"
#include "shaders/shared/frame_uniforms.h"

namespace burin::renderer {

enum class PipelineKind : std::size_t {
    solid,                  // the shapes, and the workpiece where it is lit at every pixel
    solid_beside_capsules,  // the same, with the shadow of the scene's capsules
    solid_shaded,           // with the shadows of its objects
    fine,                   // the workpiece where it is lit at its vertices
    backdrop,               // the room
    backdrop_without_shadows,
    backdrop_plain,   // without shadows and grid
    backdrop_shaded,  // with the shadows of the scene's objects too
    // The far faces of what is clear, drawn before its near faces. Neither writes depth. Both are for the glass pass
    // where the targets have one.
    glass_back,
    glass_front,
    hidden,  // near faces of what lies behind something else: no depth is read or written
    count
};

class Pipelines {
public:
    [[nodiscard]] static Result<Pipelines> create(gpu::Device& device);

    // Returns the pipeline for the passes of these targets, which must have the same number of samples at every call
    // but may have any views. fades: parallax fades towards the screen's edges.
    [[nodiscard]] Result<VkPipeline> pipeline(gpu::Device& device, PipelineKind kind, bool fades,
                                              const FrameTargets& targets);
    [[nodiscard]] std::uint32_t created() const { return created_; }  // compiled so far
    [[nodiscard]] VkPipelineLayout layout() const { return layout_.raw(); }
    [[nodiscard]] VkDescriptorSet set() const { return set_; }
    [[nodiscard]] ShadowMap& shadow_map() { return shadow_map_; }
    [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.raw(); }
    // Buffer of FrameUniforms. It is filled by a frame's own commands,
    // so that frames may follow one another without waiting.
    [[nodiscard]] const gpu::Buffer& uniforms() const { return uniforms_; }

private:
    [[nodiscard]] Result<void> create_layouts(gpu::Device& device);
    [[nodiscard]] Result<void> create_set(gpu::Device& device);
    void fill_set(const gpu::Device& device);

    gpu::Buffer uniforms_;
    ShadowMap shadow_map_;
    gpu::SetLayoutHandle set_layout_;
    gpu::PipelineLayoutHandle layout_;
    gpu::DescriptorPoolHandle pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;  // freed with its pool
    using OfEachKind = std::array<gpu::PipelineHandle, static_cast<std::size_t>(PipelineKind::count)>;
    // Indexed by views, then by whether parallax fades.
    std::array<std::array<OfEachKind, 2>, kViewChoices> pipelines_;
    std::uint32_t created_ = 0;
};

}  // namespace burin::renderer
