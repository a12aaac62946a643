// SPDX-License-Identifier: MIT
// The light on a carved surface, kept up to date while it is carved: which tiles need theirs anew, a few of them at a time.
//
// follow() is called after each Surface::update: it notes which nodes changed, gives each tile with a new mesh the light that
// its nearest vertices had before, so that nothing flickers, and marks the tiles whose light may differ: all within
// kOpenReach of what changed, and those between which and the lamp it lies. step() bakes some of them: first those with a new
// mesh, then the others, nearest to a given place first.
// When nothing is pending the light is, bit for bit, that of a fresh bake of the same surface (tests/compute/surface_light_prop.cpp),
// and neither it nor what a step bakes depends on the number of threads.
//
// Cost: 40 us to bring the clearance of a tile up to date; then for each vertex 20 (flat) to 90 looks at it for open and 5 to
// 15 for sun, of about 110 instructions each: 1 to 2 us.
// Memory: 2 bytes a vertex, and what occupancy.hpp and clearance.hpp say: together some 9 KiB for each tile with surface.
// Threads: one; what shared_light() hands out may be read, and let go of, on any other while this goes on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/inner_boxes.hpp"
#include "compute/surface.hpp"
#include "compute/tile_light.hpp"

namespace burin {

class SurfaceLight {
public:
    // Nothing is lit yet; the first follow() takes everything in.
    SurfaceLight(const Lattice& lattice, const Lamp& lamp);

    // All of the sun's light anew. Fails on a direction without length or a tangent out of range, and changes nothing then.
    [[nodiscard]] Result<void> set_lamp(const Lamp& lamp);
    [[nodiscard]] const Lamp& lamp() const { return lamp_; }

    // Call it once after each mesh_all or update of the surface, before the next.
    void follow(const Solid& solid, const Surface& surface, WorkerPool& pool);
    // Bakes up to so many tiles; returns how many. The place is in the object frame, metres.
    std::size_t step(const Vec3& near_object, std::size_t most_tiles, WorkerPool& pool);
    [[nodiscard]] std::size_t pending() const { return pending_; }  // tiles that wait to be baked

    // Of the vertices of the mesh that the surface had at the last follow(), as many and in their order; null without a mesh.
    [[nodiscard]] const std::shared_ptr<const TileLight>& shared_light(std::uint32_t tile) const {
        return lights_[tile];
    }
    // The tiles baked since the last call, in increasing order. Tiles of Surface::changed_tiles() have other light too, and are
    // not named for it: whoever takes their meshes takes their light with it.
    [[nodiscard]] std::vector<std::uint32_t> take_baked();

    // True at every moment, also between a cut and the next step; more are looked for at some steps.
    [[nodiscard]] const std::vector<Box>& inner_boxes_object() const { return inner_boxes_.boxes_object(); }
    [[nodiscard]] const Occupancy& occupancy() const { return occupancy_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    enum Need : std::uint8_t { kOpen = 1, kSun = 2, kNewMesh = 4 };
    struct Waiting {
        bool later;          // no new mesh
        double distance_sq;  // tiles
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

// A tile's light after a change until it is baked: that of the same vertex before, or of the nearest one; all there is when
// there was none.
[[nodiscard]] std::vector<VertexLight> carried_over(const SurfaceTile& mesh, const SurfaceTile* before,
                                                    const TileLight* light_before);

}  // namespace burin
