// SPDX-License-Identifier: MIT
// The piece of surface near the tool that the carving side publishes to the haptic thread, and that the tick touches.
//
// Data flow: after each update the carving side fills a LocalSurface (the draft of a NewestSlot) and publishes it; the tick
// borrows the newest one. What is published is references: to the tiles of a carved surface that the ball touches, to loose
// triangles, and to the meshes of a scene (geometry/touch_mesh.hpp). No triangle is copied, and tiles need no search structure
// built.
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
#include "geometry/touch_patch.hpp"

namespace burin {

// A mesh among what can be touched.
struct TouchedMesh {
    std::shared_ptr<const TouchSnapshot> snapshot;
    std::uint8_t material = 0;  // which of the session's materials (haptics/forces/touch_material.hpp)
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

    // A triangle's id is its number among the tiles', or that of a loose one after all of those, or of a mesh's after those: all
    // tiles, all loose ones, then mesh by mesh.
    [[nodiscard]] std::uint32_t loose_triangles() const noexcept {
        return loose ? static_cast<std::uint32_t>(loose->triangles.size()) : 0u;
    }
    [[nodiscard]] std::uint32_t triangles() const noexcept;
    // All of an id below triangles(). A triangle is relative to origin_object.
    [[nodiscard]] Triangle triangle(std::uint32_t id) const noexcept;
    // Of tiles and loose triangles it is 0.
    [[nodiscard]] std::uint8_t material(std::uint32_t id) const noexcept;
    // Of loose triangles they are not known.
    [[nodiscard]] CornerNormals corner_normals(std::uint32_t id) const noexcept;
    // The length scale of what is there: a cell, the mean edge of loose triangles or that of a mesh, whichever is the
    // smallest; 0 when there are none.
    [[nodiscard]] double mean_edge_m() const noexcept;

private:
    struct Place {
        const TouchedMesh* mesh = nullptr;  // none: not of a mesh
        std::uint32_t number = 0;
    };
    [[nodiscard]] Place in_meshes(std::uint32_t id) const noexcept;
};

inline std::uint32_t triangles_of(const TouchedMesh& mesh) noexcept {
    return mesh.snapshot ? mesh.snapshot->triangles() : 0u;
}

inline std::uint32_t LocalSurface::triangles() const noexcept {
    std::uint32_t sum = tiles.triangles + loose_triangles();
    for (const TouchedMesh& mesh : meshes) sum += triangles_of(mesh);
    return sum;
}

inline LocalSurface::Place LocalSurface::in_meshes(std::uint32_t id) const noexcept {
    std::uint32_t first = tiles.triangles + loose_triangles();
    if (id < first) return {};
    for (const TouchedMesh& mesh : meshes) {
        if (id - first < triangles_of(mesh)) return {&mesh, id - first};
        first += triangles_of(mesh);
    }
    return {};
}

inline Triangle LocalSurface::triangle(std::uint32_t id) const noexcept {
    if (id < tiles.triangles) return tiles.triangle(id);
    const Place place = in_meshes(id);
    if (place.mesh == nullptr) return loose->triangle(id - tiles.triangles);
    const TouchSnapshot& snapshot = *place.mesh->snapshot;
    const Vec3 shift = snapshot.origin_object - origin_object;
    const Triangle t = snapshot.triangle(place.number);
    return {t.a + shift, t.b + shift, t.c + shift};
}

inline std::uint8_t LocalSurface::material(std::uint32_t id) const noexcept {
    const Place place = in_meshes(id);
    return place.mesh == nullptr ? std::uint8_t{0} : place.mesh->material;
}

inline CornerNormals LocalSurface::corner_normals(std::uint32_t id) const noexcept {
    if (id < tiles.triangles) return tiles.corner_normals(id);
    const Place place = in_meshes(id);
    return place.mesh == nullptr ? CornerNormals{} : place.mesh->snapshot->corner_normals(place.number);
}

inline double LocalSurface::mean_edge_m() const noexcept {
    double least = 0.0;
    const auto note = [&](double edge_m) {
        if (edge_m > 0.0 && !(least > 0.0 && least <= edge_m)) least = edge_m;
    };
    if (tiles.triangles > 0) note(tiles.cell_m);
    if (loose) note(static_cast<double>(loose->search.mean_edge_m));
    for (const TouchedMesh& mesh : meshes)
        if (mesh.snapshot) note(mesh.snapshot->mean_edge_m());
    return least;
}

}  // namespace burin
