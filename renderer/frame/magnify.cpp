// SPDX-License-Identifier: MIT
#include "renderer/frame/magnify.hpp"

#include <array>

namespace burin::renderer {
namespace {

using gpu::structure;

constexpr VkImageLayout kShown = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

VkImageMemoryBarrier turned(VkImage image, VkImageLayout from, VkImageLayout to) {
    auto change = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    change.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    change.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    change.oldLayout = from;
    change.newLayout = to;
    change.srcQueueFamilyIndex = change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    change.image = image;
    change.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 2};
    return change;
}

VkOffset3D corner_of(ImageSize size) {
    return {static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height), 1};
}

VkImageBlit whole_picture(const FrameTargets& from, const FrameTargets& to) {
    VkImageBlit blit{};
    const std::uint32_t first = from.views == Views::right ? 1 : 0, count = from.views == Views::both ? 2 : 1;
    blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, first, count};
    blit.srcOffsets[1] = corner_of(from.size);
    blit.dstOffsets[1] = corner_of(to.size);
    return blit;
}

}  // namespace

void magnify(const gpu::Device& device, gpu::Commands& commands, const FrameTargets& from, const FrameTargets& to) {
    constexpr VkImageLayout kFrom = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kTo = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    const VolkDeviceTable& vk = device.core()->vk;
    const auto turn = [&](const std::array<VkImageMemoryBarrier, 2>& changes) {
        vk.vkCmdPipelineBarrier(commands.raw(), VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                0, 0, nullptr, 0, nullptr, 2, changes.data());
    };
    turn({turned(from.picture.raw(), kShown, kFrom), turned(to.picture.raw(), VK_IMAGE_LAYOUT_UNDEFINED, kTo)});
    const VkImageBlit blit = whole_picture(from, to);
    vk.vkCmdBlitImage(commands.raw(), from.picture.raw(), kFrom, to.picture.raw(), kTo, 1, &blit, VK_FILTER_LINEAR);
    turn({turned(from.picture.raw(), kFrom, kShown), turned(to.picture.raw(), kTo, kShown)});
}

}  // namespace burin::renderer
