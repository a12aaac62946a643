// SPDX-License-Identifier: MIT
// The carved surface as all screens of a session's graphics device draw it. Keeps the tiles, so that another device
// gets them all when this one is lost.
// Thread: that of the device.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/surface/surface_store.hpp"
#include "scene/surface_update.hpp"

namespace burin::session {

class SessionSurface {
public:
    // Begins on a device with all that is kept. Screens' pictures that were made before must be dropped first.
    void open(const gpu::Device& device);
    void close() { store_.reset(); }
    // Takes tiles that changed, before or after open().
    void take(std::span<const scene::SurfaceUpdate> updates, const Vec3& lattice_origin_object);
    // Records the upload of what has changed, once a frame, before any screen is drawn; returns its bytes.
    [[nodiscard]] Result<std::uint64_t> upload(gpu::Commands& commands) { return store_->flush(commands); }
    // See SurfaceStore::refine_beside().
    void refine_beside(bool resting) { store_->refine_beside(resting); }

    // Returns what the screens' renderers draw; null while closed.
    [[nodiscard]] const std::shared_ptr<renderer::SurfaceStore>& store() const { return store_; }

private:
    void take(const scene::SurfaceUpdate& update, const Vec3& lattice_origin_object);

    std::vector<scene::TileUpdate> tiles_;  // indexed by tile number
    std::vector<Box> occluders_;
    std::shared_ptr<renderer::SurfaceStore> store_;
};

}  // namespace burin::session
