// SPDX-License-Identifier: MIT
#include "renderer/frame_targets.hpp"

#include <array>
#include <span>

namespace burin {

namespace {

using gpu::structure;

VkAttachmentDescription attachment(VkFormat format, std::uint32_t samples, bool clear, bool keep,
                                   VkImageLayout final_layout) {
    VkAttachmentDescription a{};
    a.format = format;
    a.samples = static_cast<VkSampleCountFlagBits>(samples);
    a.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a.storeOp = keep ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    a.finalLayout = final_layout;
    return a;
}

// Frames follow one another on one queue: a pass waits for all that was done with its targets before, and what comes after
// (sampling the shadow map, copying the picture) waits for it.
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
    multiview.pCorrelationMasks = &view_mask;  // the views see nearly the same
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
    info.layers = 1;  // with multiview the view mask chooses the layers
    const auto& core = device.core();
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateFramebuffer(core->device, &info, nullptr, &framebuffer); r != VK_SUCCESS) {
        return gpu::vulkan_failure("renderer", "no framebuffer", r);
    }
    return gpu::FramebufferHandle(core, framebuffer);
}

Result<void> create_shadow(gpu::Device& device, FrameTargets& t) {
    constexpr std::uint32_t n = FrameTargets::kShadowTexels;
    auto image =
        gpu::Image::create(device, {.width = n,
                                    .height = n,
                                    .layers = 1,
                                    .samples = 1,
                                    .format = FrameTargets::kDepthFormat,
                                    .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                    .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                                    .name = "shadow map"});
    if (!image) return std::unexpected(image.error());
    t.shadow_depth = std::move(*image);
    const std::array attachments{
        attachment(FrameTargets::kDepthFormat, 1, true, true, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL)};
    const VkAttachmentReference depth{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pDepthStencilAttachment = &depth;
    auto pass = create_pass(device, attachments, subpass, 0);
    if (!pass) return std::unexpected(pass.error());
    t.shadow_pass = std::move(*pass);
    const std::array views{t.shadow_depth.view()};
    auto framebuffer = create_framebuffer(device, t.shadow_pass.raw(), views, {n, n});
    if (!framebuffer) return std::unexpected(framebuffer.error());
    t.shadow_framebuffer = std::move(*framebuffer);
    return {};
}

Result<gpu::Image> create_view_image(gpu::Device& device, const FrameTargets& t, std::uint32_t samples, VkFormat format,
                                     VkImageUsageFlags usage, VkImageAspectFlags aspect, const char* name) {
    return gpu::Image::create(device, {.width = t.size.width,
                                       .height = t.size.height,
                                       .layers = 2,
                                       .samples = samples,
                                       .format = format,
                                       .usage = usage,
                                       .aspect = aspect,
                                       .name = name});
}

Result<void> create_views(gpu::Device& device, FrameTargets& t) {
    constexpr VkImageUsageFlags kDrawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    auto picture = create_view_image(device, t, 1, FrameTargets::kColourFormat,
                                     kDrawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_IMAGE_ASPECT_COLOR_BIT, "picture");
    if (!picture) return std::unexpected(picture.error());
    auto depth = create_view_image(device, t, t.samples, FrameTargets::kDepthFormat,
                                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT, "depth");
    if (!depth) return std::unexpected(depth.error());
    t.picture = std::move(*picture);
    t.depth = std::move(*depth);
    const bool resolves = t.samples > 1;
    if (resolves) {
        auto colour = create_view_image(device, t, t.samples, FrameTargets::kColourFormat, kDrawn,
                                        VK_IMAGE_ASPECT_COLOR_BIT, "samples");
        if (!colour) return std::unexpected(colour.error());
        t.colour = std::move(*colour);
    }

    std::vector<VkAttachmentDescription> attachments{
        attachment(FrameTargets::kColourFormat, 1, !resolves, true, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
        attachment(FrameTargets::kDepthFormat, t.samples, true, false,
                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL)};
    std::vector<VkImageView> views{t.picture.view(), t.depth.view()};
    if (resolves) {
        attachments.push_back(
            attachment(FrameTargets::kColourFormat, t.samples, true, false, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
        views.push_back(t.colour.view());
    }
    const VkAttachmentReference finished{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth_reference{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference sampled{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = resolves ? &sampled : &finished;
    subpass.pResolveAttachments = resolves ? &finished : nullptr;
    subpass.pDepthStencilAttachment = &depth_reference;
    auto pass = create_pass(device, attachments, subpass, 0b11);
    if (!pass) return std::unexpected(pass.error());
    t.view_pass = std::move(*pass);
    auto framebuffer = create_framebuffer(device, t.view_pass.raw(), views, t.size);
    if (!framebuffer) return std::unexpected(framebuffer.error());
    t.view_framebuffer = std::move(*framebuffer);
    return {};
}

}  // namespace

Result<FrameTargets> FrameTargets::create(gpu::Device& device, ImageSize size) {
    FrameTargets targets;
    targets.size = size;
    targets.samples = device.capabilities().msaa_samples;
    if (const auto done = create_shadow(device, targets); !done) return std::unexpected(done.error());
    if (const auto done = create_views(device, targets); !done) return std::unexpected(done.error());
    return targets;
}

}  // namespace burin
