// SPDX-License-Identifier: MIT
// The piece of surface near the tool that the carving side publishes to the haptic thread, and that the tick touches.
//
// Data flow: after each update the carving side fills a LocalSurface (the draft of a NewestSlot) and publishes it; the tick
// borrows the newest one. What is published is references: to the tiles of a carved surface that the ball touches, to loose
// triangles, or to both. No triangle is copied, and tiles need no search structure built.
// Ownership: what is referred to never changes once it is published. Only the carving side makes, copies, fills or destroys
// a LocalSurface, and so only it counts references, allocates, and frees what nobody refers to any more: the references in a
// draft lapse when it is filled again. The haptic thread reads through them and never copies one; what it reads cannot go
// away, since the slot that it has borrowed is not the writer's until it asks for a newer one.
// Positions are float, in metres, relative to origin_object, so that they keep 1e-7 of the solid's size however far it lies
// from the object's origin. A triangle winds counter-clockwise seen from outside the material; the side it turns to the
// outside is the only one that can be touched.
// Outside the ball (center_object, radius_m) nothing is known: a tick whose tool leaves it says so and gives no force. Within
// it the surface is complete, and what a tile holds beyond it is true all the same.
// made_ns is also the carving side's sign of life: while the tool is in contact it must publish at least as often as
// TickParameters::max_surface_age_s asks, even if nothing has changed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "geometry/gridded_triangles.hpp"
#include "geometry/tile_block.hpp"

namespace burin {

struct TouchSnapshot;

// A mesh among what can be touched.
struct TouchedMesh {
    std::shared_ptr<const TouchSnapshot> snapshot;
    std::uint8_t material = 0;  // which of the session's materials (haptics/forces/touch_material.hpp)
};

// The normals at a triangle's corners, of the smooth surface that it is a facet of. None where it is not known.
struct CornerNormals {
    bool known = false;
    std::array<Vec3f, 3> normals{};  // unit
};

struct LocalSurface {
    std::uint64_t sequence = 0;  // 0: never published; a tick record names the surface it used
    Nanoseconds made_ns = 0;     // when the carving side published it
    Vec3 origin_object{0.0};     // what the float positions are relative to; of tiles: the lattice's origin
    Vec3 center_object{0.0};     // the ball within which the surface is complete
    double radius_m = 0.0;
    TileBlock tiles;
    std::shared_ptr<const GriddedTriangles> loose;  // none, or with its search built
    std::vector<TouchedMesh> meshes;                // whole, wherever they are; the known ball does not bound them

    // A triangle's id is its number among the tiles', or that of a loose one after all of those.
    [[nodiscard]] std::uint32_t loose_triangles() const noexcept {
        return loose ? static_cast<std::uint32_t>(loose->triangles.size()) : 0u;
    }
    [[nodiscard]] std::uint32_t triangles() const noexcept { return tiles.triangles + loose_triangles(); }
    [[nodiscard]] std::uint8_t material(std::uint32_t) const noexcept { return 0; }
    [[nodiscard]] CornerNormals corner_normals(std::uint32_t) const noexcept { return {}; }
    // Relative to origin_object; of an id below triangles().
    [[nodiscard]] Triangle triangle(std::uint32_t id) const noexcept {
        return id < tiles.triangles ? tiles.triangle(id) : loose->triangle(id - tiles.triangles);
    }
    // The length scale of the mesh: a cell, or the mean edge of loose triangles; 0 when there are none.
    [[nodiscard]] double mean_edge_m() const noexcept {
        if (tiles.triangles > 0) return tiles.cell_m;
        return loose ? static_cast<double>(loose->search.mean_edge_m) : 0.0;
    }
};

}  // namespace burin
