// SPDX-License-Identifier: MIT
// The stereo renderer: both eyes of a head-tracked wall in one multiview pass, without any window system.
//
// Data flow: the carving side's changed tiles go into a SurfaceStore (renderer/surface/surface_store.hpp), which
// several screens share or one has to itself; record(scene) draws both views into a picture of two layers, and redraws
// only what has changed since the frame before: nothing at all when nothing has. The presenter samples both_eyes().
// Light: one directional light from above and slightly in front, hemispheric ambient. The workpiece's self-occlusion
// comes with its vertices; the tool's occlusion is added in closed form, with shadows that sharpen towards contact and
// a thin ring of the tool's colour where the surface comes near it.
// A panel may stand in the scene (Picture::panel, show_panel).
// What is left out, and why that does not show, is described in renderer/surface/patch_choice.hpp and redraw.hpp.
//
// Ownership: the renderer shares the device's core; the device's
// handle may be destroyed first. Thread: that of its Device.
// Failure: device lost, out of memory, a viewer behind the screen, a fade out of range, a surface on another device:
// Error. After an Error of the first two kinds the patches are undefined: clear them and set them again.
// The same scene and patches give the same bits on the same driver.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "base/image.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "picture/picture.hpp"
#include "picture/png.hpp"
#include "renderer/surface/patch_choice.hpp"
#include "renderer/surface/surface_store.hpp"

namespace burin::renderer {

struct RendererOptions {
    // Samples a pixel: 1, capabilities().msaa_samples, or 0 for the latter.
    std::uint32_t samples = 0;
    Savings savings{};
    Views views = Views::both;  // the views that are drawn; the other layer of render()'s result is undefined
    // The surface to draw, on the same device, whose owner flushes it before record(). Null: one of the renderer's own,
    // which record() flushes.
    std::shared_ptr<SurfaceStore> surface{};
};

// What a frame drew, and what it left out.
struct RenderStats {
    PixelRect part;                // bounds all that was redrawn; empty: nothing was
    std::vector<PixelRect> parts;  // the redrawn rectangles, which hardly overlap
    bool whole = false;            // all of the picture was drawn anew
    std::uint64_t triangles = 0;   // all of the workpiece's
    std::uint32_t patches = 0;
    PatchCounts patch_counts;           // of this frame, summed over the parts
    std::uint32_t shapes_left_out = 0;  // outside the redrawn part: of the tool, the room and the workspace
    std::uint64_t plain_room = 0;       // pixels of the room, or of what stands before it, drawn without its shadows
    std::uint32_t draws = 0;            // draw calls
    std::uint64_t uploaded_bytes = 0;   // of changed patches, for this frame; 0 where the surface is shared
    std::uint32_t pipelines = 0;        // compiled so far
};

// Returns the size at which a picture is drawn with larger pixels.
[[nodiscard]] inline ImageSize drawn_size(ImageSize picture, std::uint32_t pixel) {
    return {(picture.width + pixel - 1) / pixel, (picture.height + pixel - 1) / pixel};
}

class Renderer {
public:
    // size is that of one eye's picture, at most 8192 pixels each way.
    [[nodiscard]] static Result<Renderer> create(gpu::Device& device, ImageSize size,
                                                 const RendererOptions& options = {});
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    // Returns the surface that is drawn.
    [[nodiscard]] SurfaceStore& surface();
    // Sets the picture of the standing panel, if the scene has one: sRGB values, premultiplied
    // (PanelPainter::view()), in layout SHADER_READ_ONLY_OPTIMAL when the GPU reads it. It must live
    // as long as frames show it. Setting the same view again does nothing (PicturePanel::version
    // signals repainting). After each PanelPainter::resize() the new view must be set before the next
    // resize, since a driver may reuse an earlier view's handle. VK_NULL_HANDLE: no panel is drawn.
    void show_panel(VkImageView panel);
    // Records the commands that update the picture from the previous
    // scene to this one. Later commands may sample the picture.
    // pixel: side of what is drawn as one pixel and magnified, in pixels of the picture; 1: the full picture. A frame
    // with another than the frame before is a full redraw, so that full pictures do not depend on others before them.
    [[nodiscard]] Result<RenderStats> record(gpu::Commands& commands, const picture::Picture& picture,
                                             std::uint32_t pixel = 1);
    // Returns the two views: an array of two layers that yields linear
    // light, in layout SHADER_READ_ONLY_OPTIMAL after the first frame.
    [[nodiscard]] VkImageView both_eyes() const;
    [[nodiscard]] ImageSize size() const;
    // Changes the size of one eye's picture, or the views; the next frame is a full
    // redraw. Patches are kept with their levels. The GPU must have finished earlier
    // frames, and both_eyes() changes. After an Error the renderer is as it was.
    [[nodiscard]] Result<void> resize(ImageSize size, Views views = Views::both);
    // Make the next frame a full redraw; set_savings also replaces the savings.
    void forget_picture();
    void set_savings(const Savings& savings);

    // Records, waits, and reads the picture back.
    [[nodiscard]] Result<StereoImage> render(const picture::Picture& picture, std::uint32_t pixel = 1);
    [[nodiscard]] const RenderStats& stats() const;  // of the last frame

private:
    class Implementation;
    explicit Renderer(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace burin::renderer
