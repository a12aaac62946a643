// SPDX-License-Identifier: MIT
#include "gpu/graphics_pipeline.hpp"

#include <array>

#include "gpu/compute_pipeline.hpp"

namespace burin::gpu {

namespace {

VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage, VkShaderModule module) {
    auto info = structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
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

Result<PipelineHandle> create_graphics_pipeline(Device& device, const GraphicsPipelineSpec& spec) {
    const std::shared_ptr<Core>& core = device.core();
    auto vertex = create_shader(device, spec.vertex_spirv, spec.name + " vertex shader");
    if (!vertex) return std::unexpected(vertex.error());
    ShaderHandle fragment;
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{stage_of(VK_SHADER_STAGE_VERTEX_BIT, vertex->raw()), {}};
    if (!spec.fragment_spirv.empty()) {
        auto shader = create_shader(device, spec.fragment_spirv, spec.name + " fragment shader");
        if (!shader) return std::unexpected(shader.error());
        fragment = std::move(*shader);
        stages[1] = stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.raw());
    }

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < spec.constants.size(); ++i) entries.push_back({i, 4 * i, 4});
    const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                         spec.constants.size_bytes(), spec.constants.data()};
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
