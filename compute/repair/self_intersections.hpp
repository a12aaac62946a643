// SPDX-License-Identifier: MIT
// Pairs of triangles of a mesh that meet other than in the vertices and the edge they share (geometry/triangle_contact.hpp).
// Exact: none is missed and none is reported that is not there. Triangles that name a vertex twice are passed over.
// The result does not depend on the number of threads. Cost: about n log n; a second a million triangles on one core.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/worker_pool.hpp"
#include "geometry/triangle_mesh.hpp"

namespace burin {

using TrianglePair = std::array<std::uint32_t, 2>;  // indices of triangles, the lower first

// In ascending order.
[[nodiscard]] std::vector<TrianglePair> self_intersections(const TriangleMesh& mesh, WorkerPool& pool);

}  // namespace burin
