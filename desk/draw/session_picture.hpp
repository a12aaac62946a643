// SPDX-License-Identifier: MIT
// Draws one screen's pictures: the scene by a renderer of its own, shown in a stereo mode with the panel over it, in a
// window's images or in an image of its own for screenshots. All screens draw the same surface (session_surface.hpp).
// Thread: that of the device. What depends on the size or the mode is made anew when these change; the surface stays.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "desk/draw/presented_parts.hpp"
#include "renderer/frame/renderer.hpp"
#include "renderer/output/output_stage.hpp"
#include "renderer/panel/panel_painter.hpp"

namespace burin::session {

// The panel as it is to be painted, valid until it is laid out again.
struct PanelPicture {
    const renderer::PanelMesh& mesh;
    const renderer::PanelAtlas& atlas;
    ImageSize size;
    std::uint64_t atlases = 0;                                // counts them: a change is another atlas
    std::vector<PixelRect> parts = {};                        // where anything is painted
    std::optional<picture::PanelStand> stand = std::nullopt;  // in the scene; none: at the right of each eye's picture
};

// What moved between two scenes: all of the picture, or the tool before it.
struct PictureChange {
    bool room = false, tool = false;
};

class SessionPicture {
public:
    // samples: see RendererOptions. The surface is flushed before each draw() (SurfaceStore).
    [[nodiscard]] static Result<SessionPicture> create(gpu::Device& device, std::uint32_t samples,
                                                       std::shared_ptr<renderer::SurfaceStore> surface);

    // Draws with all triangles, for screenshots: the progress of refine_beside() must not show in them.
    void draw_in_full(bool full) { full_ = full; }
    // Makes ready for an output of this size and mode, as draw() does. An Error of the device's memory leaves what it
    // was ready for.
    [[nodiscard]] Result<void> fit(ImageSize output, const wall::OutputSettings& settings);
    // Records the scene for an output of this size and mode; without a scene it is dark. stats().parts says what of the
    // eyes' pictures changed.
    // pixel: see Renderer::record.
    [[nodiscard]] Result<void> draw(gpu::Commands& commands, std::optional<picture::Picture> scene, ImageSize output,
                                    const wall::OutputSettings& settings, std::uint32_t pixel = 1);
    // Returns how the scene differs from that of the last picture, before draw().
    [[nodiscard]] PictureChange change_to(const std::optional<picture::Picture>& scene) const;
    // Paints the panel of the next picture, or hides it where there is none; before draw().
    [[nodiscard]] Result<void> paint(gpu::Commands& commands, const std::optional<PanelPicture>& panel);
    // Returns what the last draw() and paint() changed of a target; one rectangle with everything where that is
    // unknown.
    [[nodiscard]] std::vector<PixelRect> changed(const wall::OutputPlace& place,
                                                 const wall::OutputSettings& settings) const;
    [[nodiscard]] const renderer::RenderStats& stats() const { return stats_; }
    [[nodiscard]] ImageSize eye() const { return eye_; }

    // Shows the picture, after draw(), in a window's image, which already holds the rest.
    [[nodiscard]] Result<void> show(gpu::Commands& commands, const renderer::OutputTarget& target, VkFormat format,
                                    const wall::OutputSettings& settings, const PresentedParts::Parts& parts);
    // Shows it in an image of its own and waits. After the commands of draw() have been submitted.
    [[nodiscard]] Result<Image> photograph(const wall::OutputPlace& place, const wall::OutputSettings& settings);

private:
    SessionPicture(const gpu::Device& device, std::uint32_t samples, std::shared_ptr<renderer::SurfaceStore> surface)
        : device_(device), samples_(samples), surface_(std::move(surface)) {}
    [[nodiscard]] Result<void> fit_eye(ImageSize eye, Views views);
    [[nodiscard]] renderer::EyesView eyes_to_show(const wall::OutputSettings& settings, Result<void>& failed);
    [[nodiscard]] std::optional<renderer::OverlayView> overlay() const;

    gpu::Device device_;
    std::uint32_t samples_ = 0;
    std::shared_ptr<renderer::SurfaceStore> surface_;
    std::optional<renderer::Renderer> renderer_;
    std::optional<renderer::OutputStage> window_stage_, photo_stage_;
    std::optional<renderer::PanelPainter> painter_;
    bool panel_shown_ = false, panel_changed_ = false;
    // Where the panel is painted in the eye's picture, and where it was before it changed.
    std::vector<PixelRect> panel_parts_, panel_parts_before_;
    std::uint64_t atlases_ = 0;    // whose letters the painter has
    std::uint64_t paintings_ = 0;  // number of times the panel was painted
    std::optional<picture::PicturePanel> standing_;
    std::optional<gpu::Image> pattern_;              // a test pattern, or darkness
    std::optional<wall::TestPattern> pattern_kind_;  // none: darkness
    bool dark_ = false;
    bool full_ = false, renderer_in_full_ = false;
    ImageSize pattern_size_;
    ImageSize eye_;
    Views views_ = Views::both;  // which the renderer draws
    renderer::RenderStats stats_;
    std::optional<picture::Picture> scene_;  // of the last picture; none: it was dark
};

}  // namespace burin::session
