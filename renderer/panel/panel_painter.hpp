// SPDX-License-Identifier: MIT
// Paints a panel's triangles into an image of its own, to be laid over both eyes (OutputStage) or to stand in the scene (PanelQuad).
//
//   auto painter = PanelPainter::create(device, {340, 1080}, atlas);
//   painter->record(commands, mesh);                       // nothing when the mesh is as it was
//   stage->record(commands, eyes, target, settings, painter->overlay(x, y));
//
// The image is R8G8B8A8_UNORM: sRGB values, premultiplied by alpha (OverlayColour::coded), transparent where nothing is painted, in
// layout SHADER_READ_ONLY_OPTIMAL after the first record(). Colours are mixed as sRGB values within the panel, as toolkits mean
// them; over the scene the panel is laid in linear light.
// Failure: device lost, out of memory. A mesh whose indices or runs reach beyond their end breaks a contract and is not painted.
// Thread and lifetime: as gpu::Device. Cost: comparing the mesh, 10 us; painting is a pass over the panel's own pixels.
#pragma once

#include "gpu/commands.hpp"
#include "gpu/image.hpp"
#include "renderer/output/output_stage.hpp"
#include "renderer/panel/panel_mesh.hpp"

namespace burin {

class PanelPainter {
public:
    [[nodiscard]] static Result<PanelPainter> create(gpu::Device& device, ImageSize size, const PanelAtlas& atlas);

    // Whether it painted. Commands that are not submitted afterwards have painted nothing: then call forget().
    [[nodiscard]] Result<bool> record(gpu::Commands& commands, const PanelMesh& mesh);
    // The next record() paints.
    void forget() { painted_before_ = false; }
    // The picture is lost; the next record() paints. Of the same size: nothing happens.
    [[nodiscard]] Result<void> resize(ImageSize size);

    // With its upper left corner there, in pixels of an eye's picture; `enlarged` whole times.
    [[nodiscard]] OverlayView overlay(int x, int y, int enlarged = 1) const;
    [[nodiscard]] ImageSize size() const { return size_; }
    [[nodiscard]] VkImageView view() const { return image_.view(); }
    [[nodiscard]] VkImage image() const { return image_.raw(); }
    [[nodiscard]] std::uint64_t painted() const { return painted_; }
    [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

private:
    explicit PanelPainter(const gpu::Device& device) : device_(device) {}
    [[nodiscard]] Result<void> create_pass();
    [[nodiscard]] Result<void> create_sampler();
    [[nodiscard]] Result<void> create_layouts();
    [[nodiscard]] Result<void> create_set();
    [[nodiscard]] Result<void> create_pipeline();
    [[nodiscard]] Result<void> bring(gpu::Commands& commands, const PanelMesh& mesh);
    void paint(gpu::Commands& commands, const PanelMesh& mesh) const;

    gpu::Device device_;
    ImageSize size_;
    gpu::Image image_, atlas_;
    gpu::RenderPassHandle pass_;
    gpu::FramebufferHandle framebuffer_;
    gpu::SamplerHandle sampler_;
    gpu::SetLayoutHandle set_layout_;
    gpu::PipelineLayoutHandle layout_;
    gpu::DescriptorPoolHandle pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;  // freed with its pool
    gpu::PipelineHandle pipeline_;
    gpu::Buffer vertices_, indices_;
    PanelMesh last_;
    bool painted_before_ = false;
    std::uint64_t painted_ = 0, skipped_ = 0;
};

}  // namespace burin
