// SPDX-License-Identifier: MIT
#include "renderer/output/eye_images.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/try.hpp"
#include "gpu/commands.hpp"

namespace burin::renderer {

namespace {

using gpu::structure;

std::uint64_t bytes_in(ImageSize size) { return std::uint64_t{4} * size.width * size.height; }

void move_layout(gpu::Device& device, gpu::Commands& commands, VkImage image, std::uint32_t layers, VkImageLayout from,
                 VkImageLayout to) {
    auto barrier = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, layers};
    device.core()->vk.vkCmdPipelineBarrier(commands.raw(), VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                           VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

VkBufferImageCopy whole(ImageSize size, std::uint32_t layers) {
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, layers};
    copy.imageExtent = {size.width, size.height, 1};
    return copy;
}

Result<void> finish(gpu::Commands commands) {
    BURIN_TRY(submission, std::move(commands).submit());
    return submission.wait();
}

Result<gpu::Image> upload(gpu::Device& device, std::span<const Image* const> layers, VkFormat format) {
    const ImageSize size = layers[0]->size;
    const auto count = static_cast<std::uint32_t>(layers.size());
    auto image = gpu::Image::create(device, {.width = size.width,
                                             .height = size.height,
                                             .layers = count,
                                             .format = format,
                                             .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                             .name = "picture"});
    if (!image) return image;
    BURIN_TRY(staging, gpu::Buffer::create(device, gpu::BufferUse::upload, count * bytes_in(size), "picture"));
    std::byte* to = staging.mapped().data();
    for (const Image* layer : layers) {
        BURIN_CHECK(layer->rgba.size() == bytes_in(size));
        std::memcpy(to, layer->rgba.data(), bytes_in(size));
        to += bytes_in(size);
    }
    BURIN_TRY(commands, gpu::Commands::begin(device));
    move_layout(device, commands, image->raw(), count, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy copy = whole(size, count);
    device.core()->vk.vkCmdCopyBufferToImage(commands.raw(), staging.raw(), image->raw(),
                                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    move_layout(device, commands, image->raw(), count, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    BURIN_TRY_DO(finish(std::move(commands)));
    return image;
}

}  // namespace

Result<gpu::Image> upload_eyes(gpu::Device& device, const Image& left, const Image& right) {
    BURIN_CHECK(left.size.width == right.size.width && left.size.height == right.size.height);
    const std::array layers{&left, &right};
    return upload(device, layers, VK_FORMAT_R8G8B8A8_SRGB);
}

Result<gpu::Image> upload_image(gpu::Device& device, const Image& image, VkFormat format) {
    const std::array layers{&image};
    return upload(device, layers, format);
}

Result<Image> read_back(gpu::Device& device, VkImage image, ImageSize size, VkFormat format, VkImageLayout layout,
                        std::uint32_t layer) {
    BURIN_TRY(buffer, gpu::Buffer::create(device, gpu::BufferUse::readback, bytes_in(size), "picture"));
    BURIN_TRY(commands, gpu::Commands::begin(device));
    move_layout(device, commands, image, layer + 1, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy copy = whole(size, 1);
    copy.imageSubresource.baseArrayLayer = layer;
    device.core()->vk.vkCmdCopyImageToBuffer(commands.raw(), image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.raw(),
                                             1, &copy);
    move_layout(device, commands, image, layer + 1, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
    BURIN_TRY_DO(finish(std::move(commands)));
    Image picture{size, std::vector<std::uint8_t>(bytes_in(size))};
    std::memcpy(picture.rgba.data(), buffer.mapped().data(), picture.rgba.size());
    const bool blue_first = format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
    for (std::size_t i = 0; blue_first && i < picture.rgba.size(); i += 4) {
        std::swap(picture.rgba[i], picture.rgba[i + 2]);
    }
    return picture;
}

}  // namespace burin::renderer
