// SPDX-License-Identifier: MIT
#include "renderer/frame/shadow_map.hpp"

#include <array>
#include <cstddef>
#include <utility>

#include "base/try.hpp"
#include "gpu/pipelines.hpp"
#include "renderer/frame/draw_calls.hpp"
#include "shaders/shadow.vert.spv.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::renderer {
namespace {

using gpu::structure;

constexpr VkFormat kMapFormat = VK_FORMAT_D16_UNORM;  // every device draws into it and samples it
constexpr const char* kWhereShadowMap = "shadow map";

const VkVertexInputBindingDescription kMapBinding{0, sizeof(shared::SurfaceVertex), VK_VERTEX_INPUT_RATE_VERTEX};
const VkVertexInputAttributeDescription kMapAttribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT,
                                                      offsetof(shared::SurfaceVertex, x)};

bool filters_depths(const gpu::Device& device) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device.core()->physical, kMapFormat, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0;
}

Result<gpu::SamplerHandle> create_depth_sampler(const gpu::Device& device, bool compares) {
    auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = info.minFilter = compares && filters_depths(device) ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;  // the farthest depth: beside the map all is lit
    info.compareEnable = compares ? VK_TRUE : VK_FALSE;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    const auto& core = device.core();
    VkSampler sampler = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateSampler(core->device, &info, nullptr, &sampler); r != VK_SUCCESS)
        return gpu::vulkan_failure(kWhereShadowMap, "no sampler", r);
    return gpu::SamplerHandle(core, sampler);
}

}  // namespace

Result<ShadowMap> ShadowMap::create(gpu::Device& device, VkPipelineLayout layout) {
    ShadowMap map;
    map.layout_ = layout;
    BURIN_TRY(depth, gpu::Image::create(
                         device, {.width = picture::kShadowMapSide,
                                  .height = picture::kShadowMapSide,
                                  .format = kMapFormat,
                                  .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                  .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                                  .name = kWhereShadowMap}));
    map.depth_ = std::move(depth);
    for (const bool compares : {true, false}) {
        BURIN_TRY(sampler, create_depth_sampler(device, compares));
        (compares ? map.compares_ : map.reads_) = std::move(sampler);
    }
    BURIN_TRY_DO(map.create_pass(device));
    return map;
}

Result<void> ShadowMap::create_pass(gpu::Device& device) {
    VkAttachmentDescription depth{};
    depth.format = kMapFormat;
    depth.samples = VK_SAMPLE_COUNT_1_BIT;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkAttachmentReference drawn{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pDepthStencilAttachment = &drawn;
    // The frame before has looked up what is now drawn over; this frame looks up what was drawn.
    constexpr VkPipelineStageFlags kDepths =
        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    std::array<VkSubpassDependency, 2> order{};
    order[0].srcSubpass = VK_SUBPASS_EXTERNAL;
    order[0].srcStageMask = kDepths | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    order[0].dstStageMask = kDepths;
    order[0].srcAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    order[0].dstAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    order[1].dstSubpass = VK_SUBPASS_EXTERNAL;
    order[1].srcStageMask = kDepths;
    order[1].dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    order[1].srcAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    order[1].dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    auto info = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &depth;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(order.size());
    info.pDependencies = order.data();
    const auto& core = device.core();
    VkRenderPass pass = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateRenderPass(core->device, &info, nullptr, &pass); r != VK_SUCCESS)
        return gpu::vulkan_failure(kWhereShadowMap, "no render pass", r);
    pass_ = gpu::RenderPassHandle(core, pass);
    const VkImageView view = depth_.view();
    auto frame = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    frame.renderPass = pass;
    frame.attachmentCount = 1;
    frame.pAttachments = &view;
    frame.width = frame.height = picture::kShadowMapSide;
    frame.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateFramebuffer(core->device, &frame, nullptr, &framebuffer); r != VK_SUCCESS)
        return gpu::vulkan_failure(kWhereShadowMap, "no framebuffer", r);
    framebuffer_ = gpu::FramebufferHandle(core, framebuffer);
    return {};
}

Result<void> ShadowMap::create_pipeline(gpu::Device& device) {
    if (pipeline_) return {};
    gpu::GraphicsPipelineSpec spec;
    spec.vertex_spirv = k_shadow_vert;
    spec.render_pass = pass_.raw();
    spec.layout = layout_;
    spec.bindings = std::span(&kMapBinding, 1);
    spec.attributes = std::span(&kMapAttribute, 1);
    spec.cull = VK_CULL_MODE_BACK_BIT;  // what faces away from the lamp lies behind what faces it
    spec.color_attachments = 0;
    spec.name = "shadow map pipeline";
    BURIN_TRY(made, gpu::create_graphics_pipeline(device, spec));
    pipeline_ = std::move(made);
    return {};
}

Result<bool> ShadowMap::record(gpu::Device& device, gpu::Commands& commands, const picture::LampView& view,
                               const MeshStore& meshes) {
    std::vector<Shown> now;
    for (const picture::DrawnObject* object : view.casters) now.push_back({object->mesh, object->world_from_mesh});
    if (now == shown_) return false;
    BURIN_TRY_DO(create_pipeline(device));
    shown_ = std::move(now);
    const VolkDeviceTable& vk = device.core()->vk;
    VkClearValue clear{};
    clear.depthStencil.depth = 1.0f;
    auto info = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = pass_.raw();
    info.framebuffer = framebuffer_.raw();
    info.renderArea = {{0, 0}, {picture::kShadowMapSide, picture::kShadowMapSide}};
    info.clearValueCount = 1;
    info.pClearValues = &clear;
    vk.vkCmdBeginRenderPass(commands.raw(), &info, VK_SUBPASS_CONTENTS_INLINE);
    constexpr auto kSide = static_cast<float>(picture::kShadowMapSide);
    const VkViewport viewport{0.0f, 0.0f, kSide, kSide, 0.0f, 1.0f};
    vk.vkCmdSetViewport(commands.raw(), 0, 1, &viewport);
    DrawCalls calls(device, commands, layout_);
    calls.clip({0, 0, picture::kShadowMapSide, picture::kShadowMapSide});
    calls.use(pipeline_.raw());
    calls.bind(meshes);
    shared::DrawConstants constants{};
    for (const Shown& caster : shown_) {
        constants.world_from_local = glm::mat4(view.map_from_world * matrix(caster.world_from_mesh));
        calls.draw(meshes.at(*caster.mesh), constants);
    }
    vk.vkCmdEndRenderPass(commands.raw());
    return true;
}

}  // namespace burin::renderer
