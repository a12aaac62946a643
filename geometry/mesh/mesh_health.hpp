// SPDX-License-Identifier: MIT
// Measures properties that a TriangleMesh does not guarantee: whether it is closed, manifold and consistently oriented,
// and where it is not. Reads only; see mesh_repair.hpp for repairs.
//
// Definitions. An edge is a pair of vertices; a use of it is a triangle that has both. Triangles that name a vertex
// twice have no edges. Vertices are identified by index: two vertices at one position are two (see weld_vertices).
//   boundary edge       one use
//   non-manifold edge   more than two uses
//   misoriented edge    its uses do not pair up in opposite directions (one may be left over where their number is odd)
//   hole                a simple loop of edges with an odd number of uses; such edges always form loops
//   closed              every edge has an even number of uses: a ray in general position meets the surface an even
//                       number of times, so that an inside exists, whatever the orientation
// Units: m, m^2, m^3, object frame. Cost: n log n in the triangles, about 100 bytes of working memory each.
// Deterministic.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::geometry {

// A triangle counts as degenerate when its height over its longest side is below this fraction of that side.
inline constexpr double kDegenerateHeight = 1e-12;

struct MeshHealth {
    Box bounds_m;  // bounds of the vertices that triangles use
    std::size_t vertices = 0;
    std::size_t unused_vertices = 0;
    std::size_t triangles = 0;
    // Triangles without area. They stay in the mesh, and in the topology unless an index repeats.
    std::size_t degenerate_triangles = 0;
    std::size_t duplicate_triangles = 0;  // with the same three vertices as an earlier one, in any order
    std::size_t edges = 0;
    std::size_t boundary_edges = 0;
    std::size_t holes = 0;
    std::size_t nonmanifold_edges = 0;
    std::size_t misoriented_edges = 0;
    std::size_t nonmanifold_vertices = 0;  // where triangles that share no edge touch in one vertex
    std::size_t shells = 0;                // sets of triangles connected over edges
    double area_m2 = 0.0;
    // By the divergence theorem about the bounds' centre; negative: inside out. A volume only when the mesh is closed
    // and consistently oriented.
    double signed_volume_m3 = 0.0;
    bool closed = false;
    bool consistently_oriented = false;  // no misoriented edge

    [[nodiscard]] bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
    [[nodiscard]] bool inside_out() const { return closed && consistently_oriented && signed_volume_m3 < 0.0; }
};

// Measures the mesh. Every index must be below the number of positions, as import guarantees.
[[nodiscard]] MeshHealth examine(const TriangleMesh& mesh);

// Describes each defect in a short sentence ("12 edges have only one triangle (2 holes)"); empty for a sound mesh.
[[nodiscard]] std::vector<std::string> complaints(const MeshHealth& health);

}  // namespace burin::geometry
