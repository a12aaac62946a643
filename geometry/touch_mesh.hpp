// SPDX-License-Identifier: MIT
// A triangle mesh that can be touched while it changes: for scene objects, which do not move, and for bodies that deform.
//
// Data flow: the publisher owns a TouchMesh, edits it, and hands snapshots to the haptic thread inside a LocalSurface. A snapshot
// never changes: it refers to patches of about a hundred neighbouring triangles with their own positions, normals and tree of boxes, and an
// edit makes new patches for what it touches and leaves the others shared. So publication after an edit costs as much as
// what was edited, whatever the size of the mesh, and never a rebuild.
// Frame: the object frame, metres; positions are float relative to origin_object(). Triangles wind counter-clockwise
// seen from outside.
// Threads: a TouchMesh is its publisher's alone; a snapshot may be read from any thread, and only the publisher makes and destroys
// references to one (geometry/local_surface.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "geometry/edge_table.hpp"
#include "geometry/triangle.hpp"
#include "geometry/triangle_mesh.hpp"

namespace burin {

struct TouchPatch;  // geometry/touch_patch.hpp

// What the haptic thread reads. Immutable.
struct TouchSnapshot;  // geometry/touch_patch.hpp

class TouchMesh {
public:
    // Fails on a mesh without triangles, with indices out of range, or with positions that are not finite, and names which.
    [[nodiscard]] static Result<TouchMesh> create(const TriangleMesh& mesh);
    ~TouchMesh();
    TouchMesh(TouchMesh&&) noexcept;
    TouchMesh& operator=(TouchMesh&&) noexcept;

    // Moves vertices (indices of the mesh that it was made from) to new places, object frame; normals around them follow.
    void move_vertices(std::span<const std::uint32_t> vertices, std::span<const Vec3> positions_object_m);
    // All of them: a body that deforms. Boxes are refitted; the tree keeps its shape.
    void move_all(std::span<const Vec3> positions_object_m);
    // A piece of surface is cut out and another put in: triangles (by index) go away, new ones come. Vertex indices of `added`
    // at or above vertices() are new vertices, whose places follow in new_positions.
    void replace(std::span<const std::uint32_t> removed_triangles, std::span<const VertexTriple> added,
                 std::span<const Vec3> new_positions_object_m);

    // What is there now. Costs what has changed since the last one.
    [[nodiscard]] std::shared_ptr<const TouchSnapshot> snapshot();

    [[nodiscard]] std::size_t triangles() const;
    [[nodiscard]] std::size_t vertices() const;
    // Patches made anew since the mesh was made: the cost of editing, counted.
    [[nodiscard]] std::uint64_t patches_made() const;

private:
    struct Parts;
    explicit TouchMesh(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace burin
