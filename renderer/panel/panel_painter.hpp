// SPDX-License-Identifier: MIT
// Paints a panel's triangles into an image of its own, to be laid
// over both eyes (OutputStage) or to stand in the scene (PanelQuad).
//
//   auto painter = PanelPainter::create(device, {340, 1080}, atlas);
//   painter->record(commands, mesh);                       // records nothing if the mesh is unchanged
//   stage->record(commands, eyes, target, settings, painter->overlay(x, y));
//
// The image is R8G8B8A8_UNORM: sRGB values, premultiplied by alpha (OverlayColour::coded), transparent where nothing is
// painted, in layout SHADER_READ_ONLY_OPTIMAL after the first record(). Within the panel, colours are blended as sRGB
// values, as toolkits expect; over the scene the panel is blended in linear light.
// Failure: device lost, out of memory. A mesh whose indices or
// runs are out of range breaks a contract and is not painted.
// Thread and lifetime: as gpu::Device. Cost: comparing the mesh, 10 us; painting is a pass over the panel's own pixels.
#pragma once

#include "gpu/commands.hpp"
#include "gpu/image.hpp"
#include "renderer/output/output_stage.hpp"
#include "renderer/panel/panel_mesh.hpp"

namespace burin::renderer {

class PanelPainter {
public:
    [[nodiscard]] static Result<PanelPainter> create(gpu::Device& device, ImageSize size, const PanelAtlas& atlas);

    // Records the painting of the mesh unless it is painted already; returns whether it did. If the commands are not
    // submitted afterwards, call forget().
    [[nodiscard]] Result<bool> record(gpu::Commands& commands, const PanelMesh& mesh);
    // Makes the next record() paint.
    void forget() { painted_before_ = false; }
    // Resizes the image and discards its contents, so that the
    // next record() paints. Does nothing if the size is the same.
    [[nodiscard]] Result<void> resize(ImageSize size);

    // Returns the panel with its upper left corner at (x, y), in
    // pixels of an eye's picture, enlarged by a whole factor.
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

}  // namespace burin::renderer
