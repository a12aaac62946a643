// SPDX-License-Identifier: MIT
#include "renderer/frame/pipelines.hpp"

#include <cstddef>

#include "base/try.hpp"
#include "gpu/pipelines.hpp"
#include "renderer/surface/patch_detail.hpp"
#include "shaders/backdrop.frag.spv.hpp"
#include "shaders/backdrop.vert.spv.hpp"
#include "shaders/backdrop_shaded.frag.spv.hpp"
#include "shaders/fine.frag.spv.hpp"
#include "shaders/fine.vert.spv.hpp"
#include "shaders/glass.frag.spv.hpp"
#include "shaders/glass.vert.spv.hpp"
#include "shaders/shared/surface_vertex.h"
#include "shaders/solid.frag.spv.hpp"
#include "shaders/solid.vert.spv.hpp"
#include "shaders/solid_shaded.frag.spv.hpp"

namespace burin::renderer {

namespace {

using gpu::structure;

constexpr VkShaderStageFlags kAllStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

const std::array<VkVertexInputBindingDescription, 2> kBindings{
    {{0, sizeof(shared::SurfaceVertex), VK_VERTEX_INPUT_RATE_VERTEX},
     {1, sizeof(geometry::VertexLight), VK_VERTEX_INPUT_RATE_VERTEX}}};
const std::array<VkVertexInputAttributeDescription, 4> kAttributes{
    {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(shared::SurfaceVertex, x)},
     {1, 0, VK_FORMAT_R32_UINT, offsetof(shared::SurfaceVertex, normal)},
     {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(shared::SurfaceVertex, colour)},
     {3, 1, VK_FORMAT_R8G8_UNORM, 0}}};

gpu::GraphicsPipelineSpec spec_of(PipelineKind kind) {
    gpu::GraphicsPipelineSpec spec;
    spec.bindings = kBindings;
    spec.attributes = kAttributes;
    spec.vertex_spirv = k_solid_vert;
    switch (kind) {
        case PipelineKind::solid:
        case PipelineKind::solid_beside_capsules:
        case PipelineKind::solid_shaded:
            spec.name = "solid pipeline";
            spec.fragment_spirv = k_solid_frag;
            if (kind == PipelineKind::solid_shaded) spec.fragment_spirv = k_solid_shaded_frag;
            spec.cull = VK_CULL_MODE_BACK_BIT;
            break;
        case PipelineKind::fine:
            spec.name = "fine surface pipeline";
            spec.vertex_spirv = k_fine_vert;
            spec.fragment_spirv = k_fine_frag;
            spec.cull = VK_CULL_MODE_BACK_BIT;
            break;
        case PipelineKind::backdrop:
        case PipelineKind::backdrop_without_shadows:
        case PipelineKind::backdrop_plain:
        case PipelineKind::backdrop_shaded:
            spec.name = "backdrop pipeline";
            spec.vertex_spirv = k_backdrop_vert;
            spec.attributes = std::span(kAttributes).first(1);
            spec.depth_write = false;
            spec.fragment_spirv = k_backdrop_frag;
            if (kind == PipelineKind::backdrop_shaded) spec.fragment_spirv = k_backdrop_shaded_frag;
            break;
        case PipelineKind::glass_back:
        case PipelineKind::glass_front:
        case PipelineKind::hidden:
            spec.name = "glass pipeline";
            spec.vertex_spirv = k_glass_vert;
            spec.fragment_spirv = k_glass_frag;
            spec.attributes = std::span(kAttributes).first(3);
            spec.depth_test = kind != PipelineKind::hidden;
            spec.depth_write = false;
            spec.blend = true;
            spec.cull = kind == PipelineKind::glass_back ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
            break;
        case PipelineKind::count: break;
    }
    return spec;
}

}  // namespace

Result<Pipelines> Pipelines::create(gpu::Device& device) {
    Pipelines p;
    BURIN_TRY(uniforms,
              gpu::Buffer::create(device, gpu::BufferUse::uniform, sizeof(shared::FrameUniforms), "frame uniforms"));
    p.uniforms_ = std::move(uniforms);
    auto done = p.create_layouts(device);
    if (!done) return std::unexpected(done.error());
    BURIN_TRY(map, ShadowMap::create(device, p.layout_.raw()));
    p.shadow_map_ = std::move(map);
    if (done) done = p.create_set(device);
    if (!done) return std::unexpected(done.error());
    return p;
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

Result<void> Pipelines::create_set(gpu::Device& device) {
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
    fill_set(device);
    return {};
}

void Pipelines::fill_set(const gpu::Device& device) {
    const VkDescriptorBufferInfo buffer{uniforms_.raw(), 0, VK_WHOLE_SIZE};
    const std::array<VkDescriptorImageInfo, 2> maps{shadow_map_.compared(), shadow_map_.depths()};
    std::array<VkWriteDescriptorSet, 3> writes{};
    writes.fill(structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET));
    for (VkWriteDescriptorSet& write : writes) {
        write.dstSet = set_;
        write.descriptorCount = 1;
    }
    writes[0].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    writes[0].pBufferInfo = &buffer;
    for (std::uint32_t i : {1u, 2u}) {
        writes[i].dstBinding = i;
        writes[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        writes[i].pImageInfo = &maps[i - 1];
    }
    const auto& core = device.core();
    core->vk.vkUpdateDescriptorSets(core->device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

Result<VkPipeline> Pipelines::pipeline(gpu::Device& device, PipelineKind kind, bool fades,
                                       const FrameTargets& targets) {
    const bool shadows = kind == PipelineKind::backdrop || kind == PipelineKind::backdrop_shaded,
               grid = shadows || kind == PipelineKind::backdrop_without_shadows;
    // The room is behind the screen, where nothing fades.
    if (grid || kind == PipelineKind::backdrop_plain) fades = false;
    OfEachKind& kinds = pipelines_[static_cast<std::size_t>(targets.views)][fades ? 1 : 0];
    gpu::PipelineHandle& kept = kinds[static_cast<std::size_t>(kind)];
    const bool beside_capsules = kind == PipelineKind::solid_beside_capsules;
    const bool software = device.info().is_software();
    if (!kept) {
        gpu::GraphicsPipelineSpec spec = spec_of(kind);
        const bool in_glass_pass =
            targets.encodes && (kind == PipelineKind::glass_back || kind == PipelineKind::glass_front);
        const bool encodes = targets.encodes && !in_glass_pass;
        const std::array<std::uint32_t, 7> constants{encodes ? 1u : 0u,  fades ? 1u : 0u,           grid ? 1u : 0u,
                                                     shadows ? 1u : 0u,  beside_capsules ? 1u : 0u, software ? 0u : 8u,
                                                     software ? 4u : 16u};
        spec.layout = layout_.raw();
        spec.render_pass = in_glass_pass ? targets.glass_pass.raw() : targets.whole_pass.raw();
        spec.samples = targets.samples;
        spec.constants = constants;
        BURIN_TRY(created, gpu::create_graphics_pipeline(device, spec));
        kept = std::move(created);
        ++created_;
    }
    return kept.raw();
}

}  // namespace burin::renderer
