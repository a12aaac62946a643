// SPDX-License-Identifier: MIT
#include "desk/draw/session_surface.hpp"

#include "compute/light/tile_light.hpp"

namespace burin::session {

void SessionSurface::open(const gpu::Device& device) {
    store_ = std::make_shared<renderer::SurfaceStore>(device);
    for (const scene::TileUpdate& tile : tiles_) {
        if (!tile.surface) continue;
        store_->set_patch(tile.tile, tile.surface);
        if (tile.light) store_->set_patch_light(tile.tile, tile.light->vertices);
    }
    store_->set_occluders(occluders_);
}

void SessionSurface::take(std::span<const scene::SurfaceUpdate> updates, const Vec3& lattice_origin_object) {
    for (const scene::SurfaceUpdate& update : updates) take(update, lattice_origin_object);
    if (store_ && !updates.empty()) store_->set_occluders(occluders_);
}

void SessionSurface::take(const scene::SurfaceUpdate& update, const Vec3& lattice_origin_object) {
    for (const scene::TileUpdate& tile : update.tiles) {
        if (tile.tile >= tiles_.size()) tiles_.resize(tile.tile + 1);
        const bool same_mesh = tiles_[tile.tile].surface == tile.surface;
        tiles_[tile.tile] = tile;
        if (!store_) continue;
        if (!same_mesh) store_->set_patch(tile.tile, tile.surface);
        if (tile.light) store_->set_patch_light(tile.tile, tile.light->vertices);
    }
    occluders_.clear();
    for (const Box& box : update.inner_boxes_object)
        occluders_.push_back({box.lo - lattice_origin_object, box.hi - lattice_origin_object});
}

}  // namespace burin::session
