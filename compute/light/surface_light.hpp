// SPDX-License-Identifier: MIT
// Keeps the baked light of a carved surface up to date while it is carved, a few tiles at a time.
//
// follow() is called after each Surface::update: it notes which nodes changed, gives each tile with a new mesh the
// light that its nearest vertices had before, so that nothing flickers, and marks the tiles whose light may differ: all
// tiles within kOpenReach of the change, and those that the change may shade from the lamp. step() bakes some of them:
// first those with a new mesh, then the others, nearest to a given position first.
// When nothing is pending the light equals, bit for bit, that of a full bake of the same surface
// (tests/compute/surface_light_prop.cpp), and neither it nor what a step bakes depends on the number of threads.
//
// Cost: 40 us to update the clearance of a tile; then for each vertex 20 (flat) to 90 clearance lookups for open and 5
// to 15 for sun, of about 110 instructions each: 1 to 2 us.
// Memory: 2 bytes a vertex, and what occupancy.hpp and clearance.hpp state: together some 9 KiB for each tile with
// surface.
// Threads: one; the objects that shared_light() returns may be read and released on any other thread meanwhile.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/light/inner_boxes.hpp"
#include "compute/light/tile_light.hpp"
#include "compute/mesher/surface.hpp"

namespace burin::compute {

class SurfaceLight {
public:
    // Starts without light; the first follow() takes in the whole surface.
    SurfaceLight(const Lattice& lattice, const Lamp& lamp);

    // Changes the lamp and marks all tiles for their sun light. Fails on a direction without length or a tangent out of
    // range, and then changes nothing.
    [[nodiscard]] Result<void> set_lamp(const Lamp& lamp);
    [[nodiscard]] const Lamp& lamp() const { return lamp_; }

    // Takes in the changes of the surface. To be called once after each mesh_all or update of the surface, before the
    // next.
    void follow(const Solid& solid, const Surface& surface, WorkerPool& pool);
    // Bakes at most `most_tiles` tiles, those near `near_object` (object frame, metres) first; returns how many.
    std::size_t step(const Vec3& near_object, std::size_t most_tiles, WorkerPool& pool);
    [[nodiscard]] std::size_t pending() const { return pending_; }  // tiles that wait to be baked

    // Returns the light of a tile: one entry for each vertex of the mesh that the surface had at the last follow(), in
    // the same order; null without a mesh.
    [[nodiscard]] const std::shared_ptr<const TileLight>& shared_light(std::uint32_t tile) const {
        return lights_[tile];
    }
    // Returns the tiles baked since the last call, in increasing order. Tiles of Surface::changed_tiles() also have new
    // light but are not listed for it: whoever takes their meshes takes their light as well.
    [[nodiscard]] std::vector<std::uint32_t> take_baked();

    // Returns boxes that lie inside the solid at any time, also between a cut and the next step; some steps search for
    // more.
    [[nodiscard]] const std::vector<Box>& inner_boxes_object() const { return inner_boxes_.boxes_object(); }
    [[nodiscard]] const Occupancy& occupancy() const { return occupancy_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    enum Need : std::uint8_t { kOpen = 1, kSun = 2, kNewMesh = 4 };
    struct Waiting {
        bool later;          // true without a new mesh, so that these tiles sort last
        double distance_sq;  // in tile widths, squared
        std::uint32_t tile;
        auto operator<=>(const Waiting&) const = default;
    };

    void need(std::uint32_t tile, std::uint8_t what);
    void need_open_near(const NodeBox& changed);
    void need_sun_behind(const NodeBox& changed);
    void take_meshes(const Surface& surface, std::span<const std::uint32_t> changed, WorkerPool& pool);
    [[nodiscard]] std::vector<Waiting> next_to_bake(const Vec3& near_object, std::size_t most) const;
    void bake(std::uint32_t tile);

    Lattice lattice_;
    TileGrid grid_;
    Lamp lamp_;
    Occupancy occupancy_;
    Clearance clearance_;
    InnerBoxes inner_boxes_;
    std::uint64_t steps_ = 0, boxes_found_at_ = 0;
    bool full_tiles_changed_ = false, followed_ = false;
    std::vector<std::shared_ptr<const TileMesh>> meshes_;
    std::vector<std::shared_ptr<const TileLight>> lights_;
    std::vector<std::uint8_t> needs_;
    std::vector<std::uint8_t> baked_;
    std::size_t pending_ = 0;
};

// Returns the light that a tile has after a change until it is baked: for each vertex that of the same vertex before,
// or of the nearest one; full light if there was none.
[[nodiscard]] std::vector<geometry::VertexLight> carried_over(const geometry::SurfaceTile& mesh,
                                                              const geometry::SurfaceTile* before,
                                                              const TileLight* light_before);

}  // namespace burin::compute
