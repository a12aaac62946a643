// SPDX-License-Identifier: MIT
#include "renderer/frame/readback.hpp"

#include <cstdint>
#include <utility>

namespace burin::renderer {

using gpu::structure;

namespace {

std::uint64_t layer_bytes(ImageSize size) { return std::uint64_t{4} * size.width * size.height; }

}  // namespace

Result<void> Readback::fit(gpu::Device& device, ImageSize size) {
    if (buffer_.size_bytes() > 0 && size == size_) return {};
    auto buffer = gpu::Buffer::create(device, gpu::BufferUse::readback, 2 * layer_bytes(size), "pictures");
    if (!buffer) return std::unexpected(buffer.error());
    buffer_ = std::move(*buffer);
    size_ = size;
    return {};
}

void Readback::copy(const gpu::Device& device, gpu::Commands& commands, VkImage picture) {
    const VolkDeviceTable& vk = device.core()->vk;
    const auto turn = [&](VkImageLayout from, VkImageLayout to) {
        auto change = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
        change.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
        change.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        change.oldLayout = from;
        change.newLayout = to;
        change.srcQueueFamilyIndex = change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        change.image = picture;
        change.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 2};
        vk.vkCmdPipelineBarrier(commands.raw(), VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                0, 0, nullptr, 0, nullptr, 1, &change);
    };
    turn(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 2};  // layers lie one after the other in the buffer
    region.imageExtent = {size_.width, size_.height, 1};
    vk.vkCmdCopyImageToBuffer(commands.raw(), picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer_.raw(), 1, &region);
    turn(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

StereoImage Readback::pictures() const {
    const std::uint64_t bytes = layer_bytes(size_);
    const auto picture = [&](std::uint64_t layer) {
        const auto pixels = buffer_.mapped_as<std::uint8_t>().subspan(layer * bytes, bytes);
        return Image{size_, {pixels.begin(), pixels.end()}};
    };
    return {picture(0), picture(1)};
}

}  // namespace burin::renderer
