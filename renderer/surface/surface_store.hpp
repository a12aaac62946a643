// SPDX-License-Identifier: MIT
// The workpiece's surface on one graphics device, for all screens that the device draws: its patches with their light
// (patch_store.hpp), boxes of solid material, and a thread that computes coarser levels (detail_worker.hpp).
//
//   auto surface = std::make_shared<SurfaceStore>(device);
//   auto left = Renderer::create(device, size, {.surface = surface}), front = ...;
//   surface->set_patch(id, tile);
//   surface->flush(commands);                    // once a frame, before the first screen's record()
//   left->record(commands, scene); front->record(commands, other_scene);
//   surface->refine_beside(false);               // between frames
//
// Positions are relative to the scenes' lattice_origin_object, metres.
// Ownership: shares the device's core and is shared by its renderers. Thread: that of its Device.
// Failure: out of memory: Error of flush(); the surface is then incomplete until all patches are set again.
// A device that is lost takes the store with it; a job in progress ends with the store and refers to tiles alone.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gpu/commands.hpp"
#include "gpu/device.hpp"
#include "renderer/surface/detail_worker.hpp"
#include "renderer/surface/patch_store.hpp"
#include "shaders/shared/surface_vertex.h"

namespace burin::renderer {

class SurfaceStore {
public:
    explicit SurfaceStore(const gpu::Device& device) : device_(device) {}

    // Sets one tile of the workpiece's surface, replacing the patch of this id; its light is full until
    // set_patch_light. Three indices a triangle, each below vertices.size() (BURIN_CHECK; an invalid patch is left
    // out). It is uploaded by the next flush. An empty patch, or null, removes it.
    void set_patch(std::uint32_t id, std::shared_ptr<const geometry::SurfaceTile> surface);
    void set_patch(std::uint32_t id, std::span<const shared::SurfaceVertex> vertices,
                   std::span<const std::uint32_t> indices);       // copies the data
    void remove_patch(std::uint32_t id) { patches_.remove(id); }  // an unknown id is ignored
    void clear_patches() { patches_.clear(); }
    // Sets one light value for each vertex of the patch; any other number is ignored.
    void set_patch_light(std::uint32_t id, std::span<const geometry::VertexLight> light);
    // Sets boxes that lie wholly inside the workpiece, in the patches' frame: what they hide from both eyes is not
    // drawn. The caller must remove boxes that are no longer solid before the next frame.
    void set_occluders(std::vector<Box> occluders) { occluders_ = std::move(occluders); }
    [[nodiscard]] std::span<const Box> occluders() const { return occluders_; }

    // Records the upload of what has changed; later commands may draw it. Returns the bytes uploaded.
    [[nodiscard]] Result<std::uint64_t> flush(gpu::Commands& commands);

    // Computes coarser levels for up to `most` patches in view of any screen and returns for how many it did. They are
    // used from a screen's next full redraw on. For idle times; some 1 ms each.
    std::size_t refine(std::size_t most);
    // Does the same on a low-priority thread of its own; call it between frames. Recently changed patches are left
    // alone unless `resting`. When enough is done, a screen's next frame is a full redraw with the new levels.
    void refine_beside(bool resting);

    [[nodiscard]] bool is_on(const gpu::Device& device) const { return device_.core() == device.core(); }
    [[nodiscard]] PatchStore& patches() { return patches_; }
    [[nodiscard]] const PatchStore& patches() const { return patches_; }
    // Sums since the store was made.
    struct Work {
        std::uint64_t uploads = 0, uploaded_bytes = 0;  // flushes that uploaded anything
        std::uint64_t detail_jobs = 0;                  // patches given to be simplified
    };
    [[nodiscard]] const Work& work() const { return work_; }

private:
    gpu::Device device_;
    PatchStore patches_;
    std::vector<Box> occluders_;
    DetailWorker detail_;
    Work work_;
};

}  // namespace burin::renderer
