// SPDX-License-Identifier: MIT
// Shows a picture of two layers (left eye 0, right eye 1) in a stereo mode, on the GPU: one triangle over the target,
// each of whose pixels fetches the eyes' pixels that it is made of. The result is that of compose() (compose.hpp): the
// same bytes in modes that copy, at most one step of 255 off where light is mixed.
//
//   auto stage = OutputStage::create(device, swapchain.format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
//   stage->record(commands, {.eyes = picture.view(), .eye_size = size}, {.view = frame.views[0], .place = place},
//                 settings);
//
// The picture is R8G8B8A8_SRGB, with usage SAMPLED, in layout SHADER_READ_ONLY_OPTIMAL; its writes have been made
// visible to fragment shaders by a barrier or a render pass dependency. Modes that show one eye at a time (two layers,
// two windows, frame sequential) take one record() for each target, with OutputPlace::eye.
// Targets: R8G8B8A8 or B8G8R8A8, SRGB or UNORM, with usage COLOR_ATTACHMENT, left in `final_layout`.
// Thread and lifetime: as gpu::Device. Cost: compiling 20-100 ms at the first use of a mode; then a few microseconds on
// the CPU a target, and on the GPU a read and a write of each pixel.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "base/image.hpp"
#include "gpu/commands.hpp"
#include "gpu/image.hpp"
#include "shaders/shared/output_constants.h"
#include "wall/output_settings.hpp"

namespace burin::renderer {

struct EyesView {
    VkImageView eyes = VK_NULL_HANDLE;  // 2D array of two layers
    ImageSize eye_size;
};

struct OutputTarget {
    VkImageView view = VK_NULL_HANDLE;  // 2D
    wall::OutputPlace place;
};

// The panel laid over both eyes: a 2D view of an RGBA8 image with usage SAMPLED, in layout SHADER_READ_ONLY_OPTIMAL; an
// SRGB view for OverlayColour::linear, a UNORM one for coded.
struct OverlayView {
    VkImageView view = VK_NULL_HANDLE;
    wall::OverlayPlace place;
    wall::OverlayColour colour = wall::OverlayColour::linear;
};

class OutputStage {
public:
    [[nodiscard]] static Result<OutputStage> create(gpu::Device& device, VkFormat target_format,
                                                    VkImageLayout final_layout);

    // Draws the whole target and discards its previous contents. Errors are also kept for Commands::submit().
    [[nodiscard]] Result<void> record(gpu::Commands& commands, const EyesView& eyes, const OutputTarget& target,
                                      const wall::OutputSettings& settings,
                                      const std::optional<OverlayView>& overlay = std::nullopt);

    // Draws only these parts, as computed by changed_parts() (compose.hpp); the rest of the target is kept. The target
    // is in `final_layout`, as an earlier record() or presentation left it.
    [[nodiscard]] Result<void> record_parts(gpu::Commands& commands, const EyesView& eyes, const OutputTarget& target,
                                            const wall::OutputSettings& settings, std::span<const PixelRect> parts,
                                            const std::optional<OverlayView>& overlay = std::nullopt);

    [[nodiscard]] VkFormat format() const { return format_; }

private:
    explicit OutputStage(const gpu::Device& device) : device_(device) {}
    [[nodiscard]] Result<gpu::RenderPassHandle> create_pass(bool keep, VkImageLayout final_layout);
    [[nodiscard]] Result<void> create_layouts();
    [[nodiscard]] Result<VkPipeline> pipeline(int mode, int built_in);
    [[nodiscard]] Result<VkDescriptorSet> bind_images(gpu::Commands& commands, VkImageView eyes, VkImageView overlay);
    [[nodiscard]] Result<void> draw(gpu::Commands& commands, VkRenderPass pass, const EyesView& eyes,
                                    const OutputTarget& target, const wall::OutputSettings& settings,
                                    std::span<const PixelRect> parts, const std::optional<OverlayView>& overlay);
    [[nodiscard]] shared::OutputConstants constants(const EyesView& eyes, const wall::OutputPlace& place,
                                                    const wall::OutputSettings& settings,
                                                    const std::optional<OverlayView>& overlay) const;

    gpu::Device device_;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    gpu::RenderPassHandle whole_pass_, parts_pass_;
    gpu::SetLayoutHandle set_layout_;
    gpu::PipelineLayoutHandle layout_;
    std::map<std::pair<int, int>, gpu::PipelineHandle> pipelines_;  // by mode and built-in flags; created at first use
    gpu::Image no_overlay_;                                         // bound where there is no overlay; never read
};

}  // namespace burin::renderer
