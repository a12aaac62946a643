// SPDX-License-Identifier: MIT
#include "renderer/panel/panel_vulkan.hpp"

#include <algorithm>

#include "base/try.hpp"
#include "gpu/commands.hpp"

namespace burin::renderer {

namespace {

using gpu::structure;

constexpr const char* kWherePanelVulkan = "panel";

void move_layout(gpu::Device& device, gpu::Commands& commands, VkImage image, VkImageLayout from, VkImageLayout to) {
    auto barrier = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    device.core()->vk.vkCmdPipelineBarrier(commands.raw(), VK_PIPELINE_STAGE_TRANSFER_BIT,
                                           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

}  // namespace

Result<gpu::Image> upload_cover(gpu::Device& device, const PanelAtlas& atlas) {
    auto image = gpu::Image::create(device, {.width = atlas.size.width,
                                             .height = atlas.size.height,
                                             .format = VK_FORMAT_R8_UNORM,
                                             .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                             .name = "panel letters"});
    if (!image) return image;
    BURIN_TRY(staging, gpu::Buffer::create(device, gpu::BufferUse::upload, atlas.cover.size(), "panel letters"));
    std::ranges::copy(std::as_bytes(std::span(atlas.cover)), staging.mapped().begin());
    BURIN_TRY(commands, gpu::Commands::begin(device));
    move_layout(device, commands, image->raw(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {atlas.size.width, atlas.size.height, 1};
    device.core()->vk.vkCmdCopyBufferToImage(commands.raw(), staging.raw(), image->raw(),
                                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    move_layout(device, commands, image->raw(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    BURIN_TRY(submission, std::move(commands).submit());
    BURIN_TRY_DO(submission.wait());
    return image;
}

Result<gpu::SamplerHandle> create_linear_sampler(gpu::Device& device) {
    auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const auto& core = device.core();
    VkSampler sampler = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateSampler(core->device, &info, nullptr, &sampler); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWherePanelVulkan, "no sampler", r);
    }
    return gpu::SamplerHandle(core, sampler);
}

Result<gpu::SetLayoutHandle> create_picture_set_layout(gpu::Device& device) {
    const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                               VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    auto info = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = 1;
    info.pBindings = &binding;
    const auto& core = device.core();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateDescriptorSetLayout(core->device, &info, nullptr, &layout);
        r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWherePanelVulkan, "no descriptor set layout", r);
    }
    return gpu::SetLayoutHandle(core, layout);
}

Result<gpu::PipelineLayoutHandle> create_push_layout(gpu::Device& device,
                                                     std::span<const VkDescriptorSetLayout> set_layouts,
                                                     VkShaderStageFlags stages, std::uint32_t size_bytes) {
    const VkPushConstantRange push{stages, 0, size_bytes};
    auto info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = static_cast<std::uint32_t>(set_layouts.size());
    info.pSetLayouts = set_layouts.data();
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    const auto& core = device.core();
    VkPipelineLayout layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreatePipelineLayout(core->device, &info, nullptr, &layout); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWherePanelVulkan, "no pipeline layout", r);
    }
    return gpu::PipelineLayoutHandle(core, layout);
}

Result<PictureSet> create_picture_set(gpu::Device& device, const gpu::SetLayoutHandle& set_layout,
                                      const gpu::SamplerHandle& sampler, VkImageView view) {
    const auto& core = device.core();
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    auto pool_info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateDescriptorPool(core->device, &pool_info, nullptr, &pool); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWherePanelVulkan, "no descriptor pool", r);
    }
    PictureSet made{gpu::DescriptorPoolHandle(core, pool), VK_NULL_HANDLE};
    auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = set_layout.pointer();
    if (const VkResult r = core->vk.vkAllocateDescriptorSets(core->device, &info, &made.set); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWherePanelVulkan, "no descriptor set", r);
    }
    const VkDescriptorImageInfo picture{sampler.raw(), view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = made.set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &picture;
    core->vk.vkUpdateDescriptorSets(core->device, 1, &write, 0, nullptr);
    return made;
}

}  // namespace burin::renderer
