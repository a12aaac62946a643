// SPDX-License-Identifier: MIT
#include "renderer/pipelines.hpp"

#include <cstddef>

#include "gpu/graphics_pipeline.hpp"
#include "shaders/backdrop.frag.spv.hpp"
#include "shaders/backdrop.vert.spv.hpp"
#include "shaders/glass.frag.spv.hpp"
#include "shaders/glass.vert.spv.hpp"
#include "shaders/shadow.vert.spv.hpp"
#include "shaders/shared/surface_vertex.h"
#include "shaders/solid.frag.spv.hpp"
#include "shaders/solid.vert.spv.hpp"

namespace burin {

namespace {

using gpu::structure;

constexpr VkShaderStageFlags kAllStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

const std::array<VkVertexInputBindingDescription, 1> kBindings{
    {{0, sizeof(shared::SurfaceVertex), VK_VERTEX_INPUT_RATE_VERTEX}}};
const std::array<VkVertexInputAttributeDescription, 3> kAttributes{
    {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(shared::SurfaceVertex, x)},
     {1, 0, VK_FORMAT_R32_UINT, offsetof(shared::SurfaceVertex, normal)},
     {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(shared::SurfaceVertex, colour)}}};

gpu::GraphicsPipelineSpec spec_of(PipelineKind kind) {
    gpu::GraphicsPipelineSpec spec;
    spec.bindings = kBindings;
    spec.attributes = kAttributes;
    spec.vertex_spirv = k_solid_vert;
    switch (kind) {
        case PipelineKind::shadow:
            spec.name = "shadow pipeline";
            spec.vertex_spirv = k_shadow_vert;
            spec.attributes = std::span(kAttributes).first(1);
            spec.color_attachments = 0;
            // Steep surfaces cover many depths within a texel of the map.
            spec.depth_bias_slope = 2.0f;
            spec.depth_bias_constant = 1.0f;
            break;
        case PipelineKind::solid:
            spec.name = "solid pipeline";
            spec.fragment_spirv = k_solid_frag;
            spec.cull = VK_CULL_MODE_BACK_BIT;
            break;
        case PipelineKind::backdrop:
            spec.name = "backdrop pipeline";
            spec.vertex_spirv = k_backdrop_vert;
            spec.attributes = std::span(kAttributes).first(1);
            spec.depth_write = false;
            spec.fragment_spirv = k_backdrop_frag;
            break;
        case PipelineKind::glass_back:
        case PipelineKind::glass_front:
            spec.name = "glass pipeline";
            spec.vertex_spirv = k_glass_vert;
            spec.fragment_spirv = k_glass_frag;
            spec.depth_write = false;
            spec.blend = true;
            spec.cull = kind == PipelineKind::glass_back ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
            break;
        case PipelineKind::count: break;
    }
    return spec;
}

}  // namespace

Result<Pipelines> Pipelines::create(gpu::Device& device, const FrameTargets& targets) {
    Pipelines p;
    auto uniforms =
        gpu::Buffer::create(device, gpu::BufferUse::uniform, sizeof(shared::FrameUniforms), "frame uniforms");
    if (!uniforms) return std::unexpected(uniforms.error());
    p.uniforms_ = std::move(*uniforms);
    auto done = p.create_samplers(device);
    if (done) done = p.create_layouts(device);
    if (done) done = p.create_set(device, targets);
    if (!done) return std::unexpected(done.error());
    return p;
}

Result<void> Pipelines::create_samplers(gpu::Device& device) {
    const auto& core = device.core();
    VkFormatProperties format{};
    vkGetPhysicalDeviceFormatProperties(core->physical, FrameTargets::kDepthFormat, &format);
    const bool linear = (format.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0;
    auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    for (const bool compare : {false, true}) {
        info.compareEnable = compare ? VK_TRUE : VK_FALSE;
        info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
        info.minFilter = info.magFilter = compare && linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
        VkSampler sampler = VK_NULL_HANDLE;
        if (const VkResult r = core->vk.vkCreateSampler(core->device, &info, nullptr, &sampler); r != VK_SUCCESS) {
            return gpu::vulkan_failure("renderer", "no sampler", r);
        }
        (compare ? compare_sampler_ : depth_sampler_) = gpu::SamplerHandle(core, sampler);
    }
    return {};
}

Result<void> Pipelines::create_layouts(gpu::Device& device) {
    const auto& core = device.core();
    const std::array<VkDescriptorSetLayoutBinding, 3> bindings{
        {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, kAllStages, nullptr},
         {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
         {2, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    auto set_info = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateDescriptorSetLayout(core->device, &set_info, nullptr, &set_layout);
        r != VK_SUCCESS) {
        return gpu::vulkan_failure("renderer", "no descriptor set layout", r);
    }
    set_layout_ = gpu::SetLayoutHandle(core, set_layout);
    const VkPushConstantRange push{kAllStages, 0, sizeof(shared::DrawConstants)};
    auto info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = set_layout_.pointer();
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreatePipelineLayout(core->device, &info, nullptr, &layout); r != VK_SUCCESS) {
        return gpu::vulkan_failure("renderer", "no pipeline layout", r);
    }
    layout_ = gpu::PipelineLayoutHandle(core, layout);
    return {};
}

Result<void> Pipelines::create_set(gpu::Device& device, const FrameTargets& targets) {
    const auto& core = device.core();
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2}}};
    auto pool_info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateDescriptorPool(core->device, &pool_info, nullptr, &pool); r != VK_SUCCESS) {
        return gpu::vulkan_failure("renderer", "no descriptor pool", r);
    }
    pool_ = gpu::DescriptorPoolHandle(core, pool);
    auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = set_layout_.pointer();
    if (const VkResult r = core->vk.vkAllocateDescriptorSets(core->device, &info, &set_); r != VK_SUCCESS) {
        return gpu::vulkan_failure("renderer", "no descriptor set", r);
    }
    const VkDescriptorBufferInfo buffer{uniforms_.raw(), 0, VK_WHOLE_SIZE};
    const VkImageLayout layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    const std::array<VkDescriptorImageInfo, 2> images{{{compare_sampler_.raw(), targets.shadow_depth.view(), layout},
                                                       {depth_sampler_.raw(), targets.shadow_depth.view(), layout}}};
    std::array<VkWriteDescriptorSet, 2> writes{};
    writes.fill(structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET));
    writes[0].dstSet = writes[1].dstSet = set_;
    writes[0].descriptorCount = 1;
    writes[0].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    writes[0].pBufferInfo = &buffer;
    writes[1].dstBinding = 1;
    writes[1].descriptorCount = 2;  // runs on into binding 2
    writes[1].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    writes[1].pImageInfo = images.data();
    core->vk.vkUpdateDescriptorSets(core->device, 2, writes.data(), 0, nullptr);
    return {};
}

Result<VkPipeline> Pipelines::pipeline(gpu::Device& device, PipelineKind kind, const FrameTargets& targets) {
    gpu::PipelineHandle& kept = pipelines_[static_cast<std::size_t>(kind)];
    if (!kept) {
        gpu::GraphicsPipelineSpec spec = spec_of(kind);
        const bool shadow = kind == PipelineKind::shadow;
        spec.layout = layout_.raw();
        spec.render_pass = shadow ? targets.shadow_pass.raw() : targets.view_pass.raw();
        spec.samples = shadow ? 1 : targets.samples;
        auto created = gpu::create_graphics_pipeline(device, spec);
        if (!created) return std::unexpected(created.error());
        kept = std::move(*created);
    }
    return kept.raw();
}

}  // namespace burin
