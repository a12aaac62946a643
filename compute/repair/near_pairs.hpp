// SPDX-License-Identifier: MIT
// Finds the pairs of triangles that could meet beyond what they share (geometry/mesh/triangle_contact.hpp) if vertices
// moved a little: what rounding can do to a mesh is among these, and where there are none nothing needs to be looked
// at.
//
// Near-linear on meshes that defeat boxes along the axes. Long and narrow triangles across the axes are told apart by
// boxes along the triangles themselves, in a tree over the mesh. Triangles of one large fan all touch in its vertex:
// they are compared as arcs of directions around it, and never in the tree.
// Thread: any; no result depends on the number of threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/repair/self_intersections.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute {

struct NearPairs {
    std::vector<TrianglePair> pairs;  // in ascending order; each may meet, the others cannot
    std::uint64_t tests = 0;          // comparisons of boxes, arcs and triangles: the work done
    bool complete = true;             // false: so many triangles are near each other that the search was cut off
};

// Says how far each vertex may move, in the mesh's unit, and which triangles are asked about: each pair holds at least
// one of them. Empty: all triangles are.
struct NearSearch {
    std::span<const double> reach;
    std::span<const std::uint8_t> wanted = {};
};

// Requires a mesh in which different vertices are at different positions. Triangles with a repeated vertex are left
// out. Cost: about n log n where few triangles are near others, then 0.1 s for 100,000 on one core; bounded at
// kMostTestsATriangle for each triangle.
inline constexpr std::uint64_t kMostTestsATriangle = 400;
[[nodiscard]] NearPairs near_pairs(const geometry::TriangleMesh& mesh, const NearSearch& search, WorkerPool& pool);

}  // namespace burin::compute
