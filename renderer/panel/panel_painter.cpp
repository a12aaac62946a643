// SPDX-License-Identifier: MIT
#include "renderer/panel/panel_painter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/try.hpp"
#include "gpu/pipelines.hpp"
#include "renderer/panel/panel_vulkan.hpp"
#include "shaders/panel.frag.spv.hpp"
#include "shaders/panel.vert.spv.hpp"

namespace burin::renderer {

namespace {

using gpu::structure;

constexpr const char* kPanelPainter = "panel";
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

const std::array<VkVertexInputBindingDescription, 1> kPanelBindings{
    {{0, sizeof(PanelVertex), VK_VERTEX_INPUT_RATE_VERTEX}}};
const std::array<VkVertexInputAttributeDescription, 3> kPanelAttributes{
    {{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, x)},
     {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(PanelVertex, u)},
     {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(PanelVertex, rgba)}}};

bool is_whole(const PanelMesh& mesh) {
    const auto inside = [&](const PanelDraw& draw) {
        return draw.first_index <= mesh.indices.size() && draw.index_count <= mesh.indices.size() - draw.first_index;
    };
    return std::ranges::all_of(mesh.draws, inside) &&
           std::ranges::all_of(mesh.indices, [&](std::uint32_t i) { return i < mesh.vertices.size(); });
}

// Ensures the buffer's size. Allocates half more than needed, so that
// a panel that grows line by line does not reallocate each time.
Result<void> make_room(gpu::Device& device, gpu::Commands& commands, gpu::Buffer& buffer, gpu::BufferUse use,
                       std::uint64_t size_bytes) {
    if (buffer.size_bytes() >= size_bytes) return {};
    BURIN_TRY(larger, gpu::Buffer::create(device, use, std::max<std::uint64_t>(4096, size_bytes + size_bytes / 2),
                                          kPanelPainter));
    commands.keep_alive(std::move(buffer));
    buffer = std::move(larger);
    return {};
}

}  // namespace

Result<PanelPainter> PanelPainter::create(gpu::Device& device, ImageSize size, const PanelAtlas& atlas) {
    BURIN_CHECK(atlas.cover.size() == std::size_t{atlas.size.width} * atlas.size.height);
    PanelPainter painter(device);
    BURIN_TRY(letters, upload_cover(device, atlas));
    painter.atlas_ = std::move(letters);
    for (const auto step : {&PanelPainter::create_pass, &PanelPainter::create_sampler, &PanelPainter::create_layouts,
                            &PanelPainter::create_set, &PanelPainter::create_pipeline}) {
        BURIN_TRY_DO((painter.*step)());
    }
    BURIN_TRY_DO(painter.resize(size));
    return painter;
}

Result<void> PanelPainter::create_pass() {
    VkAttachmentDescription target{};
    target.format = kFormat;
    target.samples = VK_SAMPLE_COUNT_1_BIT;
    target.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    target.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    target.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    target.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    target.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    target.finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    // Before: waits for frames that show the previous picture.
    // After: frames that show this one, and a copy of it, wait.
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.srcStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
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
        return gpu::vulkan_failure(kPanelPainter, "no render pass", r);
    }
    pass_ = gpu::RenderPassHandle(core, pass);
    return {};
}

Result<void> PanelPainter::create_sampler() {
    BURIN_TRY(sampler, create_linear_sampler(device_));
    sampler_ = std::move(sampler);
    return {};
}

Result<void> PanelPainter::create_layouts() {
    BURIN_TRY(set_layout, create_picture_set_layout(device_));
    set_layout_ = std::move(set_layout);
    BURIN_TRY(layout, create_push_layout(device_, std::span(set_layout_.pointer(), 1), VK_SHADER_STAGE_VERTEX_BIT,
                                         2 * sizeof(float)));
    layout_ = std::move(layout);
    return {};
}

Result<void> PanelPainter::create_set() {
    BURIN_TRY(made, create_picture_set(device_, set_layout_, sampler_, atlas_.view()));
    pool_ = std::move(made.pool);
    set_ = made.set;
    return {};
}

Result<void> PanelPainter::create_pipeline() {
    gpu::GraphicsPipelineSpec spec;
    spec.vertex_spirv = k_panel_vert;
    spec.fragment_spirv = k_panel_frag;
    spec.render_pass = pass_.raw();
    spec.layout = layout_.raw();
    spec.bindings = kPanelBindings;
    spec.attributes = kPanelAttributes;
    spec.depth_test = spec.depth_write = false;
    spec.blend = true;
    spec.name = "panel pipeline";
    BURIN_TRY(pipeline, gpu::create_graphics_pipeline(device_, spec));
    pipeline_ = std::move(pipeline);
    return {};
}

Result<void> PanelPainter::resize(ImageSize size) {
    BURIN_CHECK(size.width > 0 && size.height > 0);
    if (image_.view() != VK_NULL_HANDLE && size.width == size_.width && size.height == size_.height) return {};
    BURIN_TRY(image, gpu::Image::create(device_, {.width = size.width,
                                                  .height = size.height,
                                                  .format = kFormat,
                                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                           VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                                                  .name = kPanelPainter}));
    const VkImageView view = image.view();
    auto info = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    info.renderPass = pass_.raw();
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = size.width;
    info.height = size.height;
    info.layers = 1;
    const auto& core = device_.core();
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateFramebuffer(core->device, &info, nullptr, &framebuffer); r != VK_SUCCESS) {
        return gpu::vulkan_failure(kPanelPainter, "no framebuffer", r);
    }
    framebuffer_ = gpu::FramebufferHandle(core, framebuffer);
    image_ = std::move(image);
    size_ = size;
    forget();
    return {};
}

OverlayView PanelPainter::overlay(int x, int y, int enlarged) const {
    return {image_.view(),
            {x, y, enlarged * static_cast<int>(size_.width), enlarged * static_cast<int>(size_.height)},
            wall::OverlayColour::coded};
}

Result<bool> PanelPainter::record(gpu::Commands& commands, const PanelMesh& mesh) {
    if (painted_before_ && mesh == last_) {
        ++skipped_;
        return false;
    }
    const bool whole = is_whole(mesh);
    BURIN_CHECK(whole);
    if (!whole) return false;
    BURIN_TRY_DO(bring(commands, mesh));
    paint(commands, mesh);
    last_ = mesh;
    painted_before_ = true;
    ++painted_;
    return true;
}

Result<void> PanelPainter::bring(gpu::Commands& commands, const PanelMesh& mesh) {
    if (mesh.indices.empty()) return {};
    const auto vertices = std::as_bytes(std::span(mesh.vertices)), indices = std::as_bytes(std::span(mesh.indices));
    auto room = make_room(device_, commands, vertices_, gpu::BufferUse::vertex, vertices.size());
    if (room) room = make_room(device_, commands, indices_, gpu::BufferUse::index, indices.size());
    if (!room) return room;
    commands.barrier();  // an earlier paint in the same commands reads them
    commands.upload(vertices_, 0, vertices);
    commands.upload(indices_, 0, indices);
    commands.barrier();
    return {};
}

void PanelPainter::paint(gpu::Commands& commands, const PanelMesh& mesh) const {
    const VolkDeviceTable& vk = device_.core()->vk;
    const VkCommandBuffer raw = commands.raw();
    const VkClearValue clear{};
    auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = pass_.raw();
    begin.framebuffer = framebuffer_.raw();
    begin.renderArea = {{0, 0}, {size_.width, size_.height}};
    begin.clearValueCount = 1;
    begin.pClearValues = &clear;
    vk.vkCmdBeginRenderPass(raw, &begin, VK_SUBPASS_CONTENTS_INLINE);
    const auto width = static_cast<float>(size_.width), height = static_cast<float>(size_.height);
    if (!mesh.indices.empty()) {
        vk.vkCmdBindPipeline(raw, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.raw());
        vk.vkCmdBindDescriptorSets(raw, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.raw(), 0, 1, &set_, 0, nullptr);
        const std::array clip_per_px{2.0f / width, 2.0f / height};
        vk.vkCmdPushConstants(raw, layout_.raw(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(clip_per_px), &clip_per_px);
        const VkViewport viewport{0.0f, 0.0f, width, height, 0.0f, 1.0f};
        vk.vkCmdSetViewport(raw, 0, 1, &viewport);
        const VkBuffer buffer = vertices_.raw();
        const VkDeviceSize offset = 0;
        vk.vkCmdBindVertexBuffers(raw, 0, 1, &buffer, &offset);
        vk.vkCmdBindIndexBuffer(raw, indices_.raw(), 0, VK_INDEX_TYPE_UINT32);
        for (const PanelDraw& draw : mesh.draws) {
            const PixelRect& c = draw.clip;
            const std::uint32_t right = std::min(size_.width, c.x + c.width);
            const std::uint32_t lower = std::min(size_.height, c.y + c.height);
            if (right <= c.x || lower <= c.y || draw.index_count == 0) continue;
            const VkRect2D scissor{{static_cast<std::int32_t>(c.x), static_cast<std::int32_t>(c.y)},
                                   {right - c.x, lower - c.y}};
            vk.vkCmdSetScissor(raw, 0, 1, &scissor);
            vk.vkCmdDrawIndexed(raw, draw.index_count, 1, draw.first_index, 0, 0);
        }
    }
    vk.vkCmdEndRenderPass(raw);
}

}  // namespace burin::renderer
