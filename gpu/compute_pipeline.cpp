// SPDX-License-Identifier: MIT
#include "gpu/compute_pipeline.hpp"

namespace burin::gpu {

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

namespace {

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

}  // namespace

Result<ComputePipeline> ComputePipeline::create(Device& device, const ComputePipelineSpec& spec) {
    const std::shared_ptr<Core>& core = device.core();
    if (spec.push_constant_bytes > core->capabilities.max_push_constant_bytes) {
        return fail(spec.name, "needs " + std::to_string(spec.push_constant_bytes) + " bytes of push constants, but " +
                                   core->info.name + " has " +
                                   std::to_string(core->capabilities.max_push_constant_bytes));
    }
    auto shader = create_shader(device, spec.spirv, spec.name);
    if (!shader) return std::unexpected(shader.error());
    auto set_layout = create_set_layout(core, spec);
    if (!set_layout) return std::unexpected(set_layout.error());
    auto layout = create_layout(core, spec, set_layout->raw());
    if (!layout) return std::unexpected(layout.error());

    std::vector<VkSpecializationMapEntry> entries(spec.constants.size());
    for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = {i, i * 4, 4};
    const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                         spec.constants.size_bytes(), spec.constants.data()};
    auto info = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.layout = layout->raw();
    info.stage = structure<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader->raw();
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = entries.empty() ? nullptr : &constants;
    VkPipeline raw = VK_NULL_HANDLE;
    if (const VkResult r =
            core->vk.vkCreateComputePipelines(core->device, core->pipeline_cache, 1, &info, nullptr, &raw);
        r != VK_SUCCESS) {
        return vulkan_failure(spec.name, "could not be compiled", r);
    }
    ComputePipeline pipeline;
    pipeline.set_layout_ = std::move(*set_layout);
    pipeline.layout_ = std::move(*layout);
    pipeline.pipeline_ = PipelineHandle(core, raw);
    pipeline.storage_buffers_ = spec.storage_buffers;
    pipeline.push_constant_bytes_ = spec.push_constant_bytes;
    return pipeline;
}

}  // namespace burin::gpu
