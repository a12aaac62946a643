// SPDX-License-Identifier: MIT
// The stereo renderer: both eyes of a head-tracked wall in one multiview pass, without any window system.
//
// Data flow: the carving side's changed tiles come in as patches (set_patch), and the light that reaches their vertices
// (set_patch_light); record(scene) brings them to the GPU and draws both views into a picture of two layers, of which it draws only
// what has changed since the frame before: nothing at all when nothing has. Whoever shows the picture samples both_eyes().
// Light: one directional light from above and slightly in front, hemispheric ambient; what the workpiece keeps off itself comes with its
// vertices, what the tool keeps off is added in closed form, with shadows that sharpen towards contact and a thin ring of
// the tool's colour where the surface comes near it.
// A panel may stand in the scene (Scene::panel, show_panel).
// What is spared, and why it does not show, stands in surface/patch_choice.hpp and redraw.hpp.
//
// Ownership: the renderer shares the device's core; the device's handle may go first. Thread: that of its Device.
// Failure: device lost, out of memory, a viewer behind the screen: Error. After an Error of the first two kinds the patches
// are undefined: clear them and set them again.
// The same scene and patches give the same bits on the same driver.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "geometry/surface_tile.hpp"
#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "renderer/image.hpp"
#include "renderer/png.hpp"
#include "renderer/scene.hpp"
#include "renderer/surface/patch_choice.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

struct RendererOptions {
    std::uint32_t samples = 0;  // a pixel: 1, or what the device has; 0: what the device has
    Savings savings{};
    Views views = Views::both;  // drawn; render() gives something else for the other one
};

// What a frame drew, and what it spared.
struct RenderStats {
    PixelRect part;                // around all that was drawn anew; empty: nothing was
    std::vector<PixelRect> parts;  // what was: rectangles that hardly overlap
    std::uint64_t triangles = 0;   // of the workpiece, all there are
    std::uint32_t patches = 0;
    PatchCounts patch_counts;           // of this frame, each part's added up
    std::uint32_t shapes_left_out = 0;  // beside the part: of the tool, the room and the workspace
    std::uint64_t plain_room = 0;       // pixels of the room, or of what stands before it, drawn without its shadows
    std::uint32_t draws = 0;            // draw calls
    std::uint64_t uploaded_bytes = 0;   // changed patches brought to the GPU for this frame
    std::uint32_t pipelines = 0;        // compiled so far
};

class Renderer {
public:
    // The size of one eye's picture; at most 8192 each way.
    [[nodiscard]] static Result<Renderer> create(gpu::Device& device, ImageSize size,
                                                 const RendererOptions& options = {});
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    // One tile of the workpiece's surface; replaces the patch of this id, and its light is full until it is set. Positions are relative to
    // the scene's lattice_origin_object. Three indices a triangle, each below vertices.size() (BURIN_CHECK; a broken patch is left
    // out). The GPU sees it at the next frame. An empty patch, or none, removes it.
    void set_patch(std::uint32_t id, std::shared_ptr<const SurfaceTile> surface);
    void set_patch(std::uint32_t id, std::span<const shared::SurfaceVertex> vertices,
                   std::span<const std::uint32_t> indices);  // copies
    void remove_patch(std::uint32_t id);                     // an unknown id is fine
    void clear_patches();
    // One for each vertex of the patch; any other number is ignored.
    void set_patch_light(std::uint32_t id, std::span<const VertexLight> light);
    // Boxes that lie wholly inside the workpiece, in the patches' frame: what they hide from both eyes is not drawn. Whoever sets
    // them takes those away that are no longer solid before the next frame.
    void set_occluders(std::vector<Box> occluders);
    // The picture of the standing panel, if the scene has one: sRGB values, premultiplied (PanelPainter::view()), in layout
    // SHADER_READ_ONLY_OPTIMAL when frames that show it get to the GPU. It must live as long as frames show it; given again, nothing
    // happens (what was painted into it ScenePanel::version tells). After each PanelPainter::resize() the new one must be given before
    // the next, since a driver may give a later view an earlier one's handle. VK_NULL_HANDLE: no panel is drawn.
    void show_panel(VkImageView panel);
    // Works out coarser levels for at most so many patches in view; how many it did. They are used from the next frame on that is drawn
    // as a whole. For times when nothing else is to be done; some 1 ms each.
    std::size_t refine(std::size_t most);
    // The same on a thread of the renderer's own, behind everything else; to be called between frames. Patches that still change come last:
    // while not resting they are left alone. When enough is done, the next frame is drawn as a whole, with it.
    void refine_beside(bool resting);

    // Records what brings the picture from the scene before to this one. The picture may be sampled by later commands.
    [[nodiscard]] Result<RenderStats> record(gpu::Commands& commands, const Scene& scene);
    // The two views: an array of two layers that gives linear light, in layout SHADER_READ_ONLY_OPTIMAL after the first frame.
    [[nodiscard]] VkImageView both_eyes() const;
    [[nodiscard]] ImageSize size() const;
    // Another size of one eye's picture, or other views: the next frame is drawn as a whole. Patches stay, and what has been worked out of them. The GPU
    // must have done with frames before, and both_eyes() is another one. After an Error the renderer is as it was.
    [[nodiscard]] Result<void> resize(ImageSize size, Views views = Views::both);
    // The next frame is drawn as a whole; or the savings change, which has the same effect.
    void forget_picture();
    void set_savings(const Savings& savings);

    // Records, waits, and reads the picture back.
    [[nodiscard]] Result<StereoImage> render(const Scene& scene);
    [[nodiscard]] const RenderStats& stats() const;  // of the last frame

private:
    class Implementation;
    explicit Renderer(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace burin
