// SPDX-License-Identifier: MIT
#include "gpu/image.hpp"

#include "base/try.hpp"

namespace burin::gpu {

Result<Image> Image::create(Device& device, const ImageSpec& spec) {
    const std::shared_ptr<Core>& core = device.core();
    const std::string where = "GPU image '" + spec.name + "'";
    const std::uint32_t limit = core->capabilities.max_image_size;
    if (spec.width == 0 || spec.height == 0 || spec.width > limit || spec.height > limit) {
        return fail(where,
                    std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels were asked for; " +
                        core->info.name + " allows 1 to " + std::to_string(limit) + " each way",
                    "choose a smaller picture");
    }
    auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = spec.format;
    info.extent = {spec.width, spec.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = spec.layers;
    info.samples = static_cast<VkSampleCountFlagBits>(spec.samples);
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = spec.usage;
    if (spec.other_formats) info.flags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    VkImage raw = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateImage(core->device, &info, nullptr, &raw); r != VK_SUCCESS) {
        return vulkan_failure(where, "could not be created", r);
    }
    Image image;
    image.image_ = ImageHandle(core, raw);

    VkMemoryRequirements requirements{};
    core->vk.vkGetImageMemoryRequirements(core->device, raw, &requirements);
    const int type = core->memory_type(requirements.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type < 0) return fail(where, core->info.name + " has no memory for images");
    auto allocate = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = static_cast<std::uint32_t>(type);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    if (const VkResult r = core->allocate(allocate, memory); r != VK_SUCCESS) {
        return vulkan_failure(where, "could not be allocated", r);
    }
    image.memory_ = MemoryHandle(core, memory);
    if (const VkResult r = core->vk.vkBindImageMemory(core->device, raw, memory, 0); r != VK_SUCCESS) {
        return vulkan_failure(where, "could not be bound to its memory", r);
    }
    image.aspect_ = spec.aspect;
    image.layers_ = spec.layers;
    BURIN_TRY(view, image.view_as(device, spec.format));
    image.view_ = std::move(view);
    return image;
}

Result<ImageViewHandle> Image::view_as(Device& device, VkFormat format) const {
    const std::shared_ptr<Core>& core = device.core();
    auto info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = image_.raw();
    info.viewType = layers_ > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect_, 0, 1, 0, layers_};
    VkImageView view = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateImageView(core->device, &info, nullptr, &view); r != VK_SUCCESS) {
        return vulkan_failure("GPU image", "has no view", r);
    }
    return ImageViewHandle(core, view);
}

}  // namespace burin::gpu
