// SPDX-License-Identifier: MIT
// Mesh decimation for export (geometry/mesh/simplify.hpp) that creates no new self-intersections. Where the decimated
// surface intersects itself, the vertices around are kept and the decimation is repeated; if that does not help in the
// end, the mesh is returned unchanged.
#pragma once

#include "base/worker_pool.hpp"
#include "geometry/mesh/simplify.hpp"

namespace burin::compute {

struct ThinnedOut {
    geometry::TriangleMesh mesh;
    std::uint64_t triangles_before = 0;
    double bound_m = 0.0;  // the requested bound
    double error_m = 0.0;  // measured in both directions; an upper bound
    // Pairs of intersecting triangles: never more afterwards than `self_intersections_before`.
    std::uint64_t self_intersections_before = 0, self_intersections = 0;
};

// Decimates the mesh within bound_m. Fails on a bound that is not a number above zero. The result does not depend on
// the number of threads. `show` is called with the progress from 0 to 1 and may be empty.
[[nodiscard]] Result<ThinnedOut> decimate(const geometry::TriangleMesh& mesh, double bound_m, WorkerPool& pool,
                                          const std::function<void(double)>& show = {});

}  // namespace burin::compute
