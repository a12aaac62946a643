// SPDX-License-Identifier: MIT
// What a mesh's triangles say about its topology, from scratch: nothing of the mesher is used.
#pragma once

#include <cstddef>

#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute::test {

struct MeshTopology {
    std::size_t open_edges = 0;            // with one triangle
    std::size_t non_manifold_edges = 0;    // with more than two
    std::size_t misoriented_edges = 0;     // with two that run the same way
    std::size_t pinched_vertices = 0;      // whose triangles do not form one closed fan
    std::size_t degenerate_triangles = 0;  // that name a vertex twice

    bool operator==(const MeshTopology&) const = default;
};

[[nodiscard]] MeshTopology topology_of(const geometry::TriangleMesh& mesh);

}  // namespace burin::compute::test
