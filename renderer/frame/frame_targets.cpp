// SPDX-License-Identifier: MIT
#include "renderer/frame/frame_targets.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/try.hpp"
#include "picture/frame_setup.hpp"

namespace burin::renderer {

namespace {

using gpu::structure;

constexpr std::uint32_t kMaxSide = 8192;

Result<void> check_size(ImageSize size) {
    if (size.width > 0 && size.height > 0 && size.width <= kMaxSide && size.height <= kMaxSide) return {};
    return fail("picture size", std::to_string(size.width) + " x " + std::to_string(size.height) + " is not possible",
                "choose 1 to " + std::to_string(kMaxSide) + " pixels each way");
}

// `clear` acts within the render area. An initial layout other than UNDEFINED preserves what lies outside of it.
VkAttachmentDescription attachment(VkFormat format, std::uint32_t samples, bool clear, bool keep, VkImageLayout before,
                                   VkImageLayout after) {
    VkAttachmentDescription a{};
    a.format = format;
    a.samples = static_cast<VkSampleCountFlagBits>(samples);
    a.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a.storeOp = keep ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.initialLayout = before;
    a.finalLayout = after;
    return a;
}

// Orders frames on one queue: a pass waits for all earlier use of its targets, and later use (showing the picture,
// copying it) waits for the pass.
std::array<VkSubpassDependency, 2> orderly() {
    constexpr VkPipelineStageFlags kFragments = VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT |
                                                VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkAccessFlags kWrites =
        VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.srcStageMask = kFragments | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    before.dstStageMask = kFragments;
    before.srcAccessMask = kWrites;
    before.dstAccessMask = kWrites | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
    VkSubpassDependency after{};
    after.dstSubpass = VK_SUBPASS_EXTERNAL;
    after.srcStageMask = kFragments;
    after.dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    after.srcAccessMask = kWrites;
    after.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
    return {before, after};
}

Result<gpu::RenderPassHandle> create_pass(gpu::Device& device, std::span<const VkAttachmentDescription> attachments,
                                          const VkSubpassDescription& subpass, std::uint32_t view_mask) {
    const auto dependencies = orderly();
    auto multiview = structure<VkRenderPassMultiviewCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO);
    multiview.subpassCount = 1;
    multiview.pViewMasks = &view_mask;
    multiview.correlationMaskCount = 1;
    multiview.pCorrelationMasks = &view_mask;  // the views are nearly the same
    auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    if (view_mask != 0) info.pNext = &multiview;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    const auto& core = device.core();
    VkRenderPass pass = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateRenderPass(core->device, &info, nullptr, &pass); r != VK_SUCCESS) {
        return gpu::vulkan_failure("renderer", "no render pass", r);
    }
    return gpu::RenderPassHandle(core, pass);
}

Result<gpu::FramebufferHandle> create_framebuffer(gpu::Device& device, VkRenderPass pass,
                                                  std::span<const VkImageView> views, ImageSize size) {
    auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    info.renderPass = pass;
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = size.width;
    info.height = size.height;
    info.layers = 1;  // with multiview the view mask selects the layers
    const auto& core = device.core();
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateFramebuffer(core->device, &info, nullptr, &framebuffer); r != VK_SUCCESS) {
        return gpu::vulkan_failure("renderer", "no framebuffer", r);
    }
    return gpu::FramebufferHandle(core, framebuffer);
}

Result<gpu::Image> create_image(gpu::Device& device, const FrameTargets& t, std::uint32_t samples, VkFormat format,
                                VkImageUsageFlags usage, VkImageAspectFlags aspect, const char* name) {
    return gpu::Image::create(device, {.width = t.size.width,
                                       .height = t.size.height,
                                       .layers = 2,
                                       .samples = samples,
                                       .format = format,
                                       .usage = usage,
                                       .aspect = aspect,
                                       .other_formats = format == FrameTargets::kEncodedFormat,
                                       .name = name});
}

Result<void> create_images(gpu::Device& device, FrameTargets& t) {
    constexpr VkImageUsageFlags kDrawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    const VkFormat format = t.encodes ? FrameTargets::kEncodedFormat : FrameTargets::kLinearFormat;
    BURIN_TRY(picture, create_image(device, t, 1, format,
                                    kDrawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                        VK_IMAGE_USAGE_SAMPLED_BIT,
                                    VK_IMAGE_ASPECT_COLOR_BIT, "picture"));
    BURIN_TRY(depth, create_image(device, t, t.samples, FrameTargets::kDepthFormat,
                                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT, "depth"));
    t.picture = std::move(picture);
    t.depth = std::move(depth);
    BURIN_TRY(view, t.picture.view_as(device, FrameTargets::kLinearFormat));
    t.both_eyes = std::move(view);
    if (t.samples == 1) return {};
    BURIN_TRY(colour, create_image(device, t, t.samples, format, kDrawn, VK_IMAGE_ASPECT_COLOR_BIT, "samples"));
    t.colour = std::move(colour);
    return {};
}

std::uint32_t view_mask_of(Views views) { return views == Views::both ? 0b11 : views == Views::left ? 0b01 : 0b10; }

// Creates the pass with its attachments: the finished picture, depth,
// and with several samples the colour that is resolved into the picture.
Result<gpu::RenderPassHandle> create_view_pass(gpu::Device& device, const FrameTargets& t, bool whole) {
    constexpr VkImageLayout kUndefined = VK_IMAGE_LAYOUT_UNDEFINED, kShown = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                            kColour = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                            kDepth = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const VkFormat format = t.encodes ? FrameTargets::kEncodedFormat : FrameTargets::kLinearFormat;
    const bool resolves = t.samples > 1;
    std::vector<VkAttachmentDescription> attachments{
        attachment(format, 1, !resolves, true, whole ? kUndefined : kShown, kShown),
        attachment(FrameTargets::kDepthFormat, t.samples, true, !resolves, kUndefined, kDepth)};  // glass_pass reads it
    if (resolves) attachments.push_back(attachment(format, t.samples, true, false, kUndefined, kColour));
    const VkAttachmentReference finished{0, kColour}, depth{1, kDepth}, sampled{2, kColour};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = resolves ? &sampled : &finished;
    subpass.pResolveAttachments = resolves ? &finished : nullptr;
    subpass.pDepthStencilAttachment = &depth;
    return create_pass(device, attachments, subpass, view_mask_of(t.views));
}

Result<void> create_glass_pass(gpu::Device& device, FrameTargets& t) {
    constexpr VkImageLayout kShown = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                            kColour = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                            kDepth = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    std::array<VkAttachmentDescription, 2> attachments{
        attachment(FrameTargets::kLinearFormat, 1, false, true, kShown, kShown),
        attachment(FrameTargets::kDepthFormat, 1, false, false, kDepth, kDepth)};
    for (VkAttachmentDescription& a : attachments) a.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    const VkAttachmentReference picture{0, kColour}, depth{1, kDepth};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &picture;
    subpass.pDepthStencilAttachment = &depth;
    BURIN_TRY(pass, create_pass(device, attachments, subpass, view_mask_of(t.views)));
    const std::array<VkImageView, 2> views{t.both_eyes.raw(), t.depth.view()};
    BURIN_TRY(framebuffer, create_framebuffer(device, pass.raw(), views, t.size));
    t.glass_pass = std::move(pass);
    t.glass_framebuffer = std::move(framebuffer);
    return {};
}

Result<void> create_passes(gpu::Device& device, FrameTargets& t) {
    for (const bool whole : {true, false}) {
        BURIN_TRY(pass, create_view_pass(device, t, whole));
        (whole ? t.whole_pass : t.part_pass) = std::move(pass);
    }
    std::vector<VkImageView> views{t.picture.view(), t.depth.view()};
    if (t.samples > 1) views.push_back(t.colour.view());
    BURIN_TRY(framebuffer, create_framebuffer(device, t.whole_pass.raw(), views, t.size));
    t.framebuffer = std::move(framebuffer);
    return t.encodes ? create_glass_pass(device, t) : Result<void>{};
}

std::uint64_t layer_bytes(ImageSize size) { return std::uint64_t{4} * size.width * size.height; }

}  // namespace

Result<FrameTargets> FrameTargets::create(gpu::Device& device, ImageSize size, std::uint32_t samples, Views views) {
    BURIN_TRY_DO(check_size(size));
    FrameTargets targets;
    targets.size = size;
    targets.samples = samples;
    targets.views = views;
    targets.encodes = samples == 1;
    BURIN_TRY_DO(create_images(device, targets));
    BURIN_TRY_DO(create_passes(device, targets));
    return targets;
}

VkViewport viewport_of(ImageSize size) {
    const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
    constexpr auto kTimes = static_cast<float>(picture::kGuard);
    return {
        -0.5f * (kTimes - 1.0f) * width, -0.5f * (kTimes - 1.0f) * height, kTimes * width, kTimes * height, 0.0f, 1.0f};
}

Result<void> Readback::fit(gpu::Device& device, ImageSize size) {
    if (buffer_.size_bytes() > 0 && size == size_) return {};
    BURIN_TRY(buffer, gpu::Buffer::create(device, gpu::BufferUse::readback, 2 * layer_bytes(size), "pictures"));
    buffer_ = std::move(buffer);
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
