// SPDX-License-Identifier: MIT
// Finds self-intersections of a mesh: pairs of triangles that meet other than in the vertices and the edge they share
// (geometry/mesh/triangle_contact.hpp). Exact: no pair is missed and none is reported falsely. Triangles with a
// repeated vertex are skipped.
// The result does not depend on the number of threads. Cost: about n log n; one second for a million triangles on one
// core.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/worker_pool.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute {

using TrianglePair = std::array<std::uint32_t, 2>;  // indices of triangles, the lower first

// Returns the pairs in ascending order.
[[nodiscard]] std::vector<TrianglePair> self_intersections(const geometry::TriangleMesh& mesh, WorkerPool& pool);

}  // namespace burin::compute
