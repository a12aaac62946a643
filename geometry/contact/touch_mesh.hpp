// SPDX-License-Identifier: MIT
// A triangle mesh that can be touched while it changes: for scene objects, which do not move, and for bodies that
// deform.
//
// Data flow: the publisher owns a TouchMesh, edits it, and hands snapshots to the haptic thread inside a LocalSurface.
// A snapshot never changes: it refers to patches of up to 256 neighbouring triangles with their own positions, normals
// and boxes (geometry/contact/touch_patch.hpp). An edit makes new patches where the mesh has changed and leaves the
// others shared. So publication after an edit costs as much as the edit, whatever the size of the mesh, and never a
// rebuild.
// Frame: the object frame, metres; positions are float relative to the middle of the mesh as it was created. Triangles
// wind counter-clockwise seen from outside; the topology may be arbitrary.
// Normals: each smooth piece has its own; pieces end where facets turn by 40 degrees or more
// (geometry/contact/touch_surface.hpp). Degenerate triangles (is_degenerate) cannot be touched; they can be again when
// their corners move apart.
// Failure: an edit that is refused changes nothing.
// Threads: a TouchMesh is its publisher's alone; a snapshot may be read from any thread, and only the publisher makes
// and destroys references to one (geometry/contact/local_surface.hpp).
// Cost: about 0.5 us a triangle to create and 130 bytes to keep, 50 of them shared with snapshots; 0.1 us for each
// triangle of the patches that an edit touches.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "geometry/contact/touch_patch.hpp"
#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

class TouchMesh {
public:
    // Fails on a mesh without triangles, with indices out of range, or with positions that are not finite or too far
    // from each other for float, and names which.
    [[nodiscard]] static Result<TouchMesh> create(const TriangleMesh& mesh);
    ~TouchMesh();
    TouchMesh(TouchMesh&&) noexcept;
    TouchMesh& operator=(TouchMesh&&) noexcept;

    // Moves vertices (indices of the original mesh) to new positions in the object frame and updates the normals around
    // them.
    [[nodiscard]] Result<void> move_vertices(std::span<const std::uint32_t> vertices,
                                             std::span<const Vec3> positions_object_m);
    // Moves all vertices, for a body that deforms. Boxes are refitted; the tree keeps its shape.
    [[nodiscard]] Result<void> move_all(std::span<const Vec3> positions_object_m);
    // Replaces a part of the surface: removes triangles (by index) and adds others. Vertex indices of `added` at or
    // above vertices() are new vertices, whose positions follow in new_positions_object_m. Returns the indices of the
    // added triangles; indices of removed triangles are reused. Vertices that no triangle uses any more keep their
    // indices.
    [[nodiscard]] Result<std::vector<std::uint32_t>> replace(std::span<const std::uint32_t> removed_triangles,
                                                             std::span<const VertexTriple> added,
                                                             std::span<const Vec3> new_positions_object_m);

    // Returns the present state. Costs what has changed since the last snapshot.
    [[nodiscard]] std::shared_ptr<const TouchSnapshot> snapshot();

    [[nodiscard]] std::size_t triangles() const;  // present ones, degenerate ones included
    [[nodiscard]] std::size_t vertices() const;
    // Number of patches made since creation: a measure of the cost of editing.
    [[nodiscard]] std::uint64_t patches_made() const;

private:
    struct Parts;
    explicit TouchMesh(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace burin::geometry
