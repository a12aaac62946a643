// SPDX-License-Identifier: MIT
// A session's pictures: the scene drawn by the renderer, and shown in a stereo mode with the panel over it, in a window's images or in one of
// its own for screenshots.
// Thread: that of the device. What depends on the size or the mode is made anew when these change; the surface stays.
#pragma once

#include <filesystem>
#include <optional>

#include "app/session/carving_desk.hpp"
#include "app/session/presented_parts.hpp"
#include "renderer/output/output_stage.hpp"
#include "renderer/panel/panel_painter.hpp"
#include "renderer/renderer.hpp"

namespace burin {

class SessionPicture {
public:
    // samples: as RendererOptions.
    [[nodiscard]] static Result<SessionPicture> create(gpu::Device& device, std::uint32_t samples);

    // Tiles that changed; kept, so that a renderer that is made anew has them all.
    void take(const SurfaceNews& news, const Vec3& lattice_origin_object);

    // For a picture on another device.
    struct Kept {
        std::vector<TileNews> tiles;  // by their numbers
        std::vector<Box> occluders;
    };
    [[nodiscard]] Kept take_kept() { return std::move(kept_); }
    void give_kept(Kept kept) { kept_ = std::move(kept); }

    // A picture to keep is drawn with all triangles: how far refine_beside() has come shall not show in it.
    void draw_in_full(bool full) { full_ = full; }
    // Records the scene for an output of this size and mode; without one it is dark. stats().parts says what of the eyes' pictures changed.
    [[nodiscard]] Result<void> draw(gpu::Commands& commands, std::optional<Scene> scene, ImageSize output,
                                    const OutputSettings& settings);
    // The panel of the picture that is drawn next, at the right of each eye's; or where a stand is given, in the scene.
    [[nodiscard]] Result<void> paint(gpu::Commands& commands, const PanelMesh& mesh, const PanelAtlas& atlas,
                                     ImageSize size, const std::optional<PanelStand>& stand);
    void hide_panel();
    // What the last draw() and paint() changed of a target; one with everything where that cannot be told.
    [[nodiscard]] std::vector<PixelRect> changed(const OutputPlace& place, const OutputSettings& settings) const;
    [[nodiscard]] const RenderStats& stats() const { return stats_; }
    [[nodiscard]] ImageSize eye() const { return eye_; }

    // After draw(): shows it in a window's image, which holds the rest as it should be.
    [[nodiscard]] Result<void> show(gpu::Commands& commands, const OutputTarget& target, VkFormat format,
                                    const OutputSettings& settings, const PresentedParts::Parts& parts);
    // The same into a picture of its own; waits. After the commands of draw() have been submitted.
    [[nodiscard]] Result<Image> photograph(const OutputPlace& place, const OutputSettings& settings);
    // As Renderer::refine_beside().
    void refine_beside(bool resting) {
        if (renderer_) renderer_->refine_beside(resting);
    }

private:
    explicit SessionPicture(const gpu::Device& device, std::uint32_t samples) : device_(device), samples_(samples) {}
    [[nodiscard]] Result<void> fit(ImageSize eye, Views views);
    [[nodiscard]] EyesView eyes_to_show(const OutputSettings& settings, Result<void>& failed);

    gpu::Device device_;
    std::uint32_t samples_ = 0;
    void put(const TileNews& tile);
    [[nodiscard]] std::optional<OverlayView> overlay() const;

    Kept kept_;
    std::optional<Renderer> renderer_;
    std::optional<OutputStage> window_stage_, photo_stage_;
    std::optional<PanelPainter> painter_;
    bool panel_shown_ = false, panel_changed_ = false;
    std::uint64_t paintings_ = 0;  // of the panel
    std::optional<ScenePanel> standing_;
    std::optional<gpu::Image> pattern_;        // a test pattern, or darkness
    std::optional<TestPattern> pattern_kind_;  // none: darkness
    bool dark_ = false;
    bool full_ = false, renderer_in_full_ = false;
    ImageSize pattern_size_;
    ImageSize eye_;
    Views views_ = Views::both;  // that the renderer draws
    RenderStats stats_;
};

}  // namespace burin
