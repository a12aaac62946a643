// SPDX-License-Identifier: MIT
// The surface near the tool that the carving side publishes to the haptic thread, and that the tick touches.
//
// Data flow: after each update the carving side fills a LocalSurface (the draft of a NewestSlot) and publishes it; the
// tick borrows the newest one. It holds references: to the tiles of a carved surface that meet the ball, to loose
// triangles, and to the meshes of a scene (geometry/contact/touch_mesh.hpp). No triangle is copied, and tiles need no
// search structure.
// Ownership: objects that are referred to never change once published. Only the carving side makes, copies, fills or
// destroys a LocalSurface, so it alone counts references, allocates, and frees objects that nobody refers to any more;
// the references in a draft are dropped when it is filled again. The haptic thread reads through the references and
// never copies one; what it reads stays alive, since the slot that it has borrowed does not return to the writer until
// it asks for a newer one.
// Positions are float, in metres, relative to origin_object, so that their resolution is 1e-7 of the solid's size
// however far it lies from the object's origin. A triangle winds counter-clockwise seen from outside the material; only
// its outer side can be touched, but for those of a mesh without thickness (TouchedMesh::two_sided).
// Validity: the surface is complete within the ball (center_object, radius_m) and unknown outside it: a tick whose tool
// leaves the ball flags that and gives no force. Triangles of a tile beyond the ball are correct all the same.
// made_ns is also the carving side's heartbeat: while the tool is in contact it must publish at least as often as
// TickParameters::max_surface_age_s asks, even if nothing has changed.
// A mesh may stand at a pose of its own, so that many share one snapshot. It may also move as a rigid body
// (TouchedMesh::motion): it is published with pose, velocity and their time, and the tick touches it where it is by
// then (haptics/contact/moving_bodies.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/clock.hpp"
#include "base/space.hpp"
#include "geometry/contact/gridded_triangles.hpp"
#include "geometry/contact/local_model.hpp"
#include "geometry/contact/mesh_motion.hpp"
#include "geometry/contact/tile_block.hpp"
#include "geometry/contact/touch_patch.hpp"

namespace burin::geometry {

// A mesh that can be touched, and its material.
struct TouchedMesh {
    std::shared_ptr<const TouchSnapshot> snapshot;
    std::uint8_t material = 0;  // which of the session's materials (haptics/forces/touch_force.hpp)
    // A surface without thickness, felt from either side: the side on which the tool is. Else only the outer side is.
    bool two_sided = false;
    MeshMotion motion{};       // by default none: the snapshot's place is in the object frame
    std::uint32_t object = 0;  // number of the scene's object, for records of what was touched; 0: none
    // Counts what has changed the object's surface or place at once, not by its motion: a tick that touches it then
    // eases from the old contact to the new one (haptics/forces/easing.hpp).
    std::uint32_t edits = 0;

    [[nodiscard]] bool moves() const noexcept { return motion.body != 0; }
    // Tells whether the mesh's frame may be another than the object frame.
    [[nodiscard]] bool has_pose() const noexcept { return moves() || motion.object_from_mesh != Pose{}; }
};

struct LocalSurface {
    std::uint64_t sequence = 0;  // 0: never published; a tick record names the surface it used
    Nanoseconds made_ns = 0;     // when the carving side published it
    Vec3 origin_object{0.0};     // origin of the float positions; for tiles: the lattice's origin
    Vec3 center_object{0.0};     // the ball within which the surface is complete
    double radius_m = 0.0;
    TileBlock tiles;
    std::uint32_t tiles_edits = 0;  // as TouchedMesh::edits: what no tool has carved, such as a stroke that is undone
    std::shared_ptr<const GriddedTriangles> loose;  // null, or with its search built
    std::vector<TouchedMesh> meshes;                // whole meshes wherever they are; the ball does not bound them
    LocalModels models;                             // of bodies that give, for each point of the probe

    // Triangle ids are consecutive: first all triangles of the tiles, then the loose ones, then those of each mesh in
    // turn.
    [[nodiscard]] std::uint32_t loose_triangles() const noexcept {
        return loose ? static_cast<std::uint32_t>(loose->triangles.size()) : 0u;
    }
    [[nodiscard]] std::uint32_t triangles() const noexcept;
    // Returns the triangle with this id, which must be below triangles(), relative to origin_object. One of a moving
    // mesh is where its mesh was published.
    [[nodiscard]] Triangle triangle(std::uint32_t id) const noexcept;
    // Returns the triangle's material; 0 for tiles and loose triangles.
    [[nodiscard]] std::uint8_t material(std::uint32_t id) const noexcept;
    // Returns the number of the object that the triangle is part of; kUnnumbered for tiles and loose triangles.
    static constexpr std::uint32_t kUnnumbered = 0xffffffffu;
    [[nodiscard]] std::uint32_t object(std::uint32_t id) const noexcept;
    // Tells whether the triangle is part of a mesh that is felt from either side.
    [[nodiscard]] bool two_sided(std::uint32_t id) const noexcept;
    // Returns the normals at the triangle's corners; unknown for loose triangles. Those of a mesh that has a pose are
    // in its own frame.
    [[nodiscard]] CornerNormals corner_normals(std::uint32_t id) const noexcept;
    // Returns the length scale of the surface: the smallest of the tiles' cell, the loose triangles' mean edge and the
    // meshes' mean edges; 0 when there are no triangles.
    [[nodiscard]] double mean_edge_m() const noexcept;
    // Returns the index of the mesh that the triangle is part of; kNoMesh for tiles and loose triangles.
    static constexpr std::uint32_t kNoMesh = 0xffffffffu;
    [[nodiscard]] std::uint32_t mesh_of(std::uint32_t id) const noexcept {
        const Place place = in_meshes(id);
        return place.mesh == nullptr ? kNoMesh : static_cast<std::uint32_t>(place.mesh - meshes.data());
    }

private:
    struct Place {
        const TouchedMesh* mesh = nullptr;  // null: not of a mesh
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
    if (place.mesh->has_pose()) {
        const Pose& pose = place.mesh->motion.object_from_mesh;
        const auto placed = [&](const Vec3& p) { return pose * (p + snapshot.origin_object) - origin_object; };
        return {placed(t.a), placed(t.b), placed(t.c)};
    }
    return {t.a + shift, t.b + shift, t.c + shift};
}

inline std::uint8_t LocalSurface::material(std::uint32_t id) const noexcept {
    const Place place = in_meshes(id);
    return place.mesh == nullptr ? std::uint8_t{0} : place.mesh->material;
}

inline std::uint32_t LocalSurface::object(std::uint32_t id) const noexcept {
    const Place place = in_meshes(id);
    return place.mesh == nullptr ? kUnnumbered : place.mesh->object;
}

inline bool LocalSurface::two_sided(std::uint32_t id) const noexcept {
    const Place place = in_meshes(id);
    return place.mesh != nullptr && place.mesh->two_sided;
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

}  // namespace burin::geometry
