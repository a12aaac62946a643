// SPDX-License-Identifier: MIT
#include "gpu/pipelines.hpp"

#include "base/try.hpp"

#include <array>

namespace burin::gpu {
namespace {

Result<ShaderHandle> create_shader(Device& device, std::span<const std::uint32_t> spirv, const std::string& name) {
    constexpr std::uint32_t kSpirvMagic = 0x07230203;
    if (spirv.size() < 5 || spirv[0] != kSpirvMagic) return fail(name, "is not SPIR-V");
    const std::shared_ptr<Core>& core = device.core();
    auto info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    VkShaderModule shader = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateShaderModule(core->device, &info, nullptr, &shader); r != VK_SUCCESS) {
        return vulkan_failure(name, "the shader was refused", r);
    }
    return ShaderHandle(core, shader);
}

VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage, VkShaderModule module) {
    auto info = structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
}

// Map the specialization constants, constant_id 0, 1, ..., to four bytes each.
std::vector<VkSpecializationMapEntry> map_entries(std::span<const std::uint32_t> constants) {
    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.push_back({i, 4 * i, 4});
    return entries;
}
VkSpecializationInfo specialization(const std::vector<VkSpecializationMapEntry>& entries,
                                    std::span<const std::uint32_t> constants) {
    return {static_cast<std::uint32_t>(entries.size()), entries.data(), constants.size_bytes(), constants.data()};
}

Result<SetLayoutHandle> create_set_layout(const std::shared_ptr<Core>& core, const ComputePipelineSpec& spec) {
    std::vector<VkDescriptorSetLayoutBinding> bindings(spec.storage_buffers);
    for (std::uint32_t i = 0; i < spec.storage_buffers; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    auto info = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = spec.storage_buffers;
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateDescriptorSetLayout(core->device, &info, nullptr, &layout);
        r != VK_SUCCESS) {
        return vulkan_failure(spec.name, "no descriptor set layout", r);
    }
    return SetLayoutHandle(core, layout);
}

Result<PipelineLayoutHandle> create_layout(const std::shared_ptr<Core>& core, const ComputePipelineSpec& spec,
                                           const VkDescriptorSetLayout& set_layout) {
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, spec.push_constant_bytes};
    auto info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = spec.push_constant_bytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreatePipelineLayout(core->device, &info, nullptr, &layout); r != VK_SUCCESS) {
        return vulkan_failure(spec.name, "no pipeline layout", r);
    }
    return PipelineLayoutHandle(core, layout);
}

VkPipelineRasterizationStateCreateInfo rasterization_of(const GraphicsPipelineSpec& spec) {
    auto info =
        structure<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    info.polygonMode = VK_POLYGON_MODE_FILL;
    info.cullMode = spec.cull;
    info.frontFace = spec.front;
    info.lineWidth = 1.0f;
    return info;
}

VkPipelineColorBlendAttachmentState blend_of(bool blend) {
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    state.blendEnable = blend ? VK_TRUE : VK_FALSE;
    state.srcColorBlendFactor = VK_BLEND_FACTOR_ONE;
    state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    state.colorBlendOp = VK_BLEND_OP_ADD;
    state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    state.alphaBlendOp = VK_BLEND_OP_ADD;
    return state;
}

}  // namespace

Result<ComputePipeline> ComputePipeline::create(Device& device, const ComputePipelineSpec& spec) {
    const std::shared_ptr<Core>& core = device.core();
    if (spec.push_constant_bytes > core->capabilities.max_push_constant_bytes) {
        return fail(spec.name, "needs " + std::to_string(spec.push_constant_bytes) + " bytes of push constants, but " +
                                   core->info.name + " has " +
                                   std::to_string(core->capabilities.max_push_constant_bytes));
    }
    BURIN_TRY(shader, create_shader(device, spec.spirv, spec.name));
    BURIN_TRY(set_layout, create_set_layout(core, spec));
    BURIN_TRY(layout, create_layout(core, spec, set_layout.raw()));

    const auto entries = map_entries(spec.constants);
    const VkSpecializationInfo constants = specialization(entries, spec.constants);
    auto info = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.layout = layout.raw();
    info.stage = stage_of(VK_SHADER_STAGE_COMPUTE_BIT, shader.raw());
    info.stage.pSpecializationInfo = entries.empty() ? nullptr : &constants;
    VkPipeline raw = VK_NULL_HANDLE;
    if (const VkResult r =
            core->vk.vkCreateComputePipelines(core->device, core->pipeline_cache, 1, &info, nullptr, &raw);
        r != VK_SUCCESS) {
        return vulkan_failure(spec.name, "could not be compiled", r);
    }
    ComputePipeline pipeline;
    pipeline.set_layout_ = std::move(set_layout);
    pipeline.layout_ = std::move(layout);
    pipeline.pipeline_ = PipelineHandle(core, raw);
    pipeline.storage_buffers_ = spec.storage_buffers;
    pipeline.push_constant_bytes_ = spec.push_constant_bytes;
    return pipeline;
}

Result<PipelineHandle> create_graphics_pipeline(Device& device, const GraphicsPipelineSpec& spec) {
    const std::shared_ptr<Core>& core = device.core();
    BURIN_TRY(vertex, create_shader(device, spec.vertex_spirv, spec.name + " vertex shader"));
    ShaderHandle fragment;
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{stage_of(VK_SHADER_STAGE_VERTEX_BIT, vertex.raw()), {}};
    if (!spec.fragment_spirv.empty()) {
        BURIN_TRY(shader, create_shader(device, spec.fragment_spirv, spec.name + " fragment shader"));
        fragment = std::move(shader);
        stages[1] = stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.raw());
    }

    const auto entries = map_entries(spec.constants);
    const VkSpecializationInfo constants = specialization(entries, spec.constants);
    if (!entries.empty()) stages[0].pSpecializationInfo = stages[1].pSpecializationInfo = &constants;

    auto input =
        structure<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    input.vertexBindingDescriptionCount = static_cast<std::uint32_t>(spec.bindings.size());
    input.pVertexBindingDescriptions = spec.bindings.data();
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(spec.attributes.size());
    input.pVertexAttributeDescriptions = spec.attributes.data();
    auto assembly =
        structure<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto viewport = structure<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    const auto rasterization = rasterization_of(spec);
    auto samples =
        structure<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = static_cast<VkSampleCountFlagBits>(spec.samples);
    auto depth =
        structure<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = spec.depth_test;
    depth.depthWriteEnable = spec.depth_write;
    depth.depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    const std::vector<VkPipelineColorBlendAttachmentState> attachments(spec.color_attachments, blend_of(spec.blend));
    auto blend =
        structure<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = spec.color_attachments;
    blend.pAttachments = attachments.data();
    const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto dynamic = structure<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();

    auto info = structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = fragment ? 2 : 1;
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = spec.layout;
    info.renderPass = spec.render_pass;
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (const VkResult r =
            core->vk.vkCreateGraphicsPipelines(core->device, core->pipeline_cache, 1, &info, nullptr, &pipeline);
        r != VK_SUCCESS) {
        return vulkan_failure(spec.name, "could not be compiled", r);
    }
    return PipelineHandle(core, pipeline);
}

}  // namespace burin::gpu
