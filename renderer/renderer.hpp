// SPDX-License-Identifier: MIT
// The offscreen stereo renderer: both eyes of a head-tracked wall in one multiview pass, without any window system.
//
// Data flow: the carving side's changed tiles come in as patches (set_patch); render(scene) brings them to the GPU, draws a
// shadow map and then both views with four samples a pixel, and returns the two pictures.
// Light: one directional light from above and slightly in front, hemispheric ambient, shadows that sharpen towards contact,
// darkening and a thin ring of the tool's colour where the surface comes near the tool.
//
// Ownership: the renderer shares the device's core; the device's handle may go first. Thread: that of its Device.
// Failure: device lost, out of memory, a viewer behind the screen: Error. After an Error of the first two kinds the patches
// are undefined: clear them and set them again. Cost: on the software driver 1.3 to 1.6 s of processor time (all cores
// together) for 200 000 triangles at 1280 x 960 an eye; the first frame compiles the pipelines (0.2-0.5 s).
// Known fault of Mesa 22.3.6's software driver: of triangles that the picture's edge or the near plane cuts, colour and
// normal are wrong in the right eye. Carved surfaces are too fine for it to show; keep other shapes finely divided.
// The same scene and patches give the same bits on the same driver.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/error.hpp"
#include "gpu/device.hpp"
#include "renderer/image.hpp"
#include "renderer/png.hpp"
#include "renderer/scene.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin {

class Renderer {
public:
    // The size of one eye's picture; at most 8192 each way.
    [[nodiscard]] static Result<Renderer> create(gpu::Device& device, ImageSize size);
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    // One tile of the workpiece's surface; replaces the patch of this id. Positions are relative to the scene's
    // lattice_origin_object. Three indices a triangle, each below vertices.size() (BURIN_CHECK; a broken patch is left
    // out). The data is copied; the GPU sees it at the next render(). An empty patch removes it.
    void set_patch(std::uint32_t id, std::span<const shared::SurfaceVertex> vertices,
                   std::span<const std::uint32_t> indices);
    void remove_patch(std::uint32_t id);  // an unknown id is fine
    void clear_patches();

    [[nodiscard]] Result<StereoImage> render(const Scene& scene);

private:
    class Implementation;
    explicit Renderer(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace burin
