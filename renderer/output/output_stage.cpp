// SPDX-License-Identifier: MIT
#include "renderer/output/output_stage.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "base/try.hpp"
#include "gpu/pipelines.hpp"
#include "renderer/output/compose.hpp"
#include "renderer/output/eye_images.hpp"
#include "shaders/output.frag.spv.hpp"
#include "shaders/output.vert.spv.hpp"

namespace burin::renderer {

namespace {

using gpu::structure;

constexpr const char* kWhere = "output stage";

bool encodes_srgb(VkFormat format) { return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB; }

bool is_known(VkFormat format) {
    return encodes_srgb(format) || format == VK_FORMAT_R8G8B8A8_UNORM || format == VK_FORMAT_B8G8R8A8_UNORM;
}

glm::vec4 column(const wall::Homography& h, int i, double w) {
    return {static_cast<float>(h[i].x), static_cast<float>(h[i].y), static_cast<float>(h[i].z), static_cast<float>(w)};
}

Result<gpu::FramebufferHandle> create_framebuffer(gpu::Device& device, VkRenderPass pass, const OutputTarget& target) {
    auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    info.renderPass = pass;
    info.attachmentCount = 1;
    info.pAttachments = &target.view;
    info.width = target.place.size.width;
    info.height = target.place.size.height;
    info.layers = 1;
    const auto& core = device.core();
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateFramebuffer(core->device, &info, nullptr, &framebuffer); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWhere, "no framebuffer", r);
    }
    return gpu::FramebufferHandle(core, framebuffer);
}

// Returns the four sides of a part that lie beside a hole in it; some may be empty.
std::array<PixelRect, 4> beside(const PixelRect& part, const PixelRect& hole) {
    const PixelRect in = common(part, hole);
    if (in.empty()) return {part};
    const std::uint32_t right = in.x + in.width, below = in.y + in.height;
    return {{{part.x, part.y, part.width, in.y - part.y},
             {part.x, below, part.width, part.y + part.height - below},
             {part.x, in.y, in.x - part.x, in.height},
             {right, in.y, part.x + part.width - right, in.height}}};
}

// Returns the part of the target on which the overlay lies, where each pixel is copied; nothing where it may be
// anywhere.
std::optional<PixelRect> overlaid(const EyesView& eyes, const wall::OutputPlace& place,
                                  const wall::OutputSettings& settings, const std::optional<OverlayView>& overlay) {
    const bool copies = mode_number(settings.mode) == shared::kModeOneEye && !settings.homography &&
                        !settings.blend.in_use() && eyes.eye_size == place.size;
    if (!copies) return std::nullopt;
    if (!overlay) return PixelRect{};
    const auto at = [](int v, std::uint32_t most) {
        return std::min(static_cast<std::uint32_t>(std::max(v, 0)), most);
    };
    const wall::OverlayPlace& p = overlay->place;
    const std::uint32_t x = at(p.x, place.size.width), y = at(p.y, place.size.height);
    return PixelRect{x, y, at(p.x + p.width, place.size.width) - x, at(p.y + p.height, place.size.height) - y};
}

}  // namespace

Result<OutputStage> OutputStage::create(gpu::Device& device, VkFormat target_format, VkImageLayout final_layout) {
    if (!is_known(target_format)) {
        return fail(kWhere, "the target is not of 8 bits a channel", "set the display to 24 bits a pixel");
    }
    OutputStage stage(device);
    stage.format_ = target_format;
    BURIN_TRY(whole, stage.create_pass(false, final_layout));
    BURIN_TRY(parts, stage.create_pass(true, final_layout));
    stage.whole_pass_ = std::move(whole);
    stage.parts_pass_ = std::move(parts);
    BURIN_TRY_DO(stage.create_layouts());
    BURIN_TRY(none, upload_image(device, {{1, 1}, {0, 0, 0, 0}}, VK_FORMAT_R8G8B8A8_SRGB));
    stage.no_overlay_ = std::move(none);
    return stage;
}

Result<VkPipeline> OutputStage::pipeline(int mode, int built_in) {
    gpu::PipelineHandle& kept = pipelines_[{mode, built_in}];
    if (kept) return kept.raw();
    const std::array constants{static_cast<std::uint32_t>(mode), static_cast<std::uint32_t>(built_in)};
    gpu::GraphicsPipelineSpec spec;
    spec.vertex_spirv = k_output_vert;
    spec.fragment_spirv = k_output_frag;
    spec.constants = constants;
    spec.render_pass = whole_pass_.raw();
    spec.layout = layout_.raw();
    spec.depth_test = spec.depth_write = false;
    spec.name = "output pipeline";
    BURIN_TRY(made, gpu::create_graphics_pipeline(device_, spec));
    kept = std::move(made);
    return kept.raw();
}

Result<gpu::RenderPassHandle> OutputStage::create_pass(bool keep, VkImageLayout final_layout) {
    VkAttachmentDescription target{};
    target.format = format_;
    target.samples = VK_SAMPLE_COUNT_1_BIT;
    target.loadOp = keep ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    target.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    target.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    target.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    target.initialLayout = keep ? final_layout : VK_IMAGE_LAYOUT_UNDEFINED;
    target.finalLayout = final_layout;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    // Before: waits at colour output, as the window system's semaphore does, and for a copy out of an earlier picture.
    // After: a copy out of the target waits for this pass; presentation waits for a semaphore.
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    before.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    before.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    VkSubpassDependency after{};
    after.dstSubpass = VK_SUBPASS_EXTERNAL;
    after.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    after.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    after.dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    after.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
    const std::array dependencies{before, after};
    auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &target;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    const auto& core = device_.core();
    VkRenderPass pass = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateRenderPass(core->device, &info, nullptr, &pass); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWhere, "no render pass", r);
    }
    return gpu::RenderPassHandle(core, pass);
}

Result<void> OutputStage::create_layouts() {
    const auto& core = device_.core();
    const std::array<VkDescriptorSetLayoutBinding, 2> bindings{
        {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr},
         {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    auto set_info = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set_info.pBindings = bindings.data();
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateDescriptorSetLayout(core->device, &set_info, nullptr, &set_layout);
        r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWhere, "no descriptor set layout", r);
    }
    set_layout_ = gpu::SetLayoutHandle(core, set_layout);
    const VkPushConstantRange push{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(shared::OutputConstants)};
    auto info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = set_layout_.pointer();
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreatePipelineLayout(core->device, &info, nullptr, &layout); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWhere, "no pipeline layout", r);
    }
    layout_ = gpu::PipelineLayoutHandle(core, layout);
    return {};
}

// Allocates a pool and a set for this recording alone. Views come and go with windows and their handles may be reused,
// so cached sets would need invalidation.
Result<VkDescriptorSet> OutputStage::bind_images(gpu::Commands& commands, VkImageView eyes, VkImageView overlay) {
    const auto& core = device_.core();
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 2};
    auto pool_info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateDescriptorPool(core->device, &pool_info, nullptr, &pool); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWhere, "no descriptor pool", r);
    }
    commands.keep_alive(gpu::DescriptorPoolHandle(core, pool));
    auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = set_layout_.pointer();
    VkDescriptorSet set = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkAllocateDescriptorSets(core->device, &info, &set); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kWhere, "no descriptor set", r);
    }
    const std::array<VkDescriptorImageInfo, 2> images{
        {{VK_NULL_HANDLE, eyes, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
         {VK_NULL_HANDLE, overlay, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}}};
    auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set;
    write.descriptorCount = 2;  // continues into binding 1
    write.descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    write.pImageInfo = images.data();
    core->vk.vkUpdateDescriptorSets(core->device, 1, &write, 0, nullptr);
    return set;
}

shared::OutputConstants OutputStage::constants(const EyesView& eyes, const wall::OutputPlace& place,
                                               const wall::OutputSettings& settings,
                                               const std::optional<OverlayView>& overlay) const {
    shared::OutputConstants c{};
    const wall::Homography h = settings.homography.value_or(wall::Homography(1.0));
    c.picture_from_output[0] = column(h, 0, 1.0 / settings.blend.gamma);
    c.picture_from_output[1] = column(h, 1, settings.blend.curve);
    c.picture_from_output[2] = column(h, 2, 0.0);
    c.blend = {static_cast<float>(settings.blend.left), static_cast<float>(settings.blend.right),
               static_cast<float>(settings.blend.top), static_cast<float>(settings.blend.bottom)};
    const bool panel = overlay && overlay->place.width > 0 && overlay->place.height > 0;
    if (panel) c.overlay = {overlay->place.x, overlay->place.y, overlay->place.width, overlay->place.height};
    c.eye_size = {static_cast<int>(eyes.eye_size.width), static_cast<int>(eyes.eye_size.height)};
    c.target_size = {static_cast<int>(place.size.width), static_cast<int>(place.size.height)};
    c.flags = mode_flags(settings, place);
    if (!encodes_srgb(format_)) c.flags |= shared::kOutputEncode;
    if (mode_number(settings.mode) == shared::kModeOneEye && eyes.eye_size == place.size)
        c.flags |= shared::kOutputSamePixels;
    if (settings.homography) c.flags |= shared::kOutputWarp;
    if (settings.blend.in_use()) c.flags |= shared::kOutputBlend;
    if (panel) c.flags |= shared::kOutputOverlay;
    if (panel && overlay->colour == wall::OverlayColour::coded) c.flags |= shared::kOutputCodedOverlay;
    return c;
}

Result<void> OutputStage::record(gpu::Commands& commands, const EyesView& eyes, const OutputTarget& target,
                                 const wall::OutputSettings& settings, const std::optional<OverlayView>& overlay) {
    const PixelRect all = all_of(target.place.size);
    return draw(commands, whole_pass_.raw(), eyes, target, settings, std::span(&all, 1), overlay);
}

Result<void> OutputStage::record_parts(gpu::Commands& commands, const EyesView& eyes, const OutputTarget& target,
                                       const wall::OutputSettings& settings, std::span<const PixelRect> parts,
                                       const std::optional<OverlayView>& overlay) {
    return parts.empty() ? Result<void>{} : draw(commands, parts_pass_.raw(), eyes, target, settings, parts, overlay);
}

Result<void> OutputStage::draw(gpu::Commands& commands, VkRenderPass pass, const EyesView& eyes,
                               const OutputTarget& target, const wall::OutputSettings& settings,
                               std::span<const PixelRect> parts, const std::optional<OverlayView>& overlay) {
    const ImageSize size = target.place.size;
    BURIN_CHECK(size.width > 0 && size.height > 0 && eyes.eye_size.width > 0 && eyes.eye_size.height > 0);
    BURIN_TRY(framebuffer, create_framebuffer(device_, pass, target));
    BURIN_TRY(set, bind_images(commands, eyes.eyes, overlay ? overlay->view : no_overlay_.view()));

    const VolkDeviceTable& vk = device_.core()->vk;
    const VkCommandBuffer raw = commands.raw();
    auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = pass;
    begin.framebuffer = framebuffer.raw();
    begin.renderArea = {{0, 0}, {size.width, size.height}};
    vk.vkCmdBeginRenderPass(raw, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vk.vkCmdBindDescriptorSets(raw, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.raw(), 0, 1, &set, 0, nullptr);
    const VkViewport viewport{0.0f, 0.0f, static_cast<float>(size.width), static_cast<float>(size.height), 0.0f, 1.0f};
    vk.vkCmdSetViewport(raw, 0, 1, &viewport);
    const auto fill = [&](const std::vector<PixelRect>& rects, const std::optional<OverlayView>& over) -> Result<void> {
        if (std::ranges::all_of(rects, [](const PixelRect& rect) { return rect.empty(); })) return {};
        const shared::OutputConstants c = constants(eyes, target.place, settings, over);
        BURIN_TRY(pipeline_for_mode, pipeline(mode_number(settings.mode), c.flags & shared::kOutputBuiltIn));
        vk.vkCmdBindPipeline(raw, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_for_mode);
        vk.vkCmdPushConstants(raw, layout_.raw(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(c), &c);
        for (const PixelRect& rect : rects) {
            if (rect.empty()) continue;
            const VkRect2D scissor{{static_cast<std::int32_t>(rect.x), static_cast<std::int32_t>(rect.y)},
                                   {rect.width, rect.height}};
            vk.vkCmdSetScissor(raw, 0, 1, &scissor);
            vk.vkCmdDraw(raw, 3, 1, 0, 0);
        }
        return {};
    };
    // Where pixels are copied, those beside the overlay are spared its mixing: the same bytes, for less.
    const std::optional<PixelRect> hole = overlaid(eyes, target.place, settings, overlay);
    std::vector<PixelRect> under, clear;
    for (const PixelRect& part : parts) {
        BURIN_CHECK(part.x + part.width <= size.width && part.y + part.height <= size.height);
        under.push_back(hole ? common(part, *hole) : part);
        if (hole) std::ranges::copy(beside(part, *hole), std::back_inserter(clear));
    }
    Result<void> done = fill(under, overlay);
    if (done) done = fill(clear, std::nullopt);
    vk.vkCmdEndRenderPass(raw);
    commands.keep_alive(std::move(framebuffer));
    return done;
}

}  // namespace burin::renderer
