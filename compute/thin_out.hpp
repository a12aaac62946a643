// SPDX-License-Identifier: MIT
// Simplification for export (geometry/simplify.hpp) that makes no new self-intersections: where the simplified surface meets
// itself, the vertices around stay and it is tried again; where that does not help, in the end, all stay.
#pragma once

#include "base/worker_pool.hpp"
#include "geometry/simplify.hpp"

namespace burin {

struct ThinnedOut {
    TriangleMesh mesh;
    std::uint64_t triangles_before = 0;
    double bound_m = 0.0;  // as asked
    double error_m = 0.0;  // measured, both ways; an upper bound
    // Pairs of triangles that meet: never more than `self_intersections_before`.
    std::uint64_t self_intersections_before = 0, self_intersections = 0;
};

// Fails on a bound that is not a number above zero. Does not depend on the number of threads. `show` may be empty.
[[nodiscard]] Result<ThinnedOut> thin_out(const TriangleMesh& mesh, double bound_m, WorkerPool& pool,
                                          const std::function<void(double)>& show = {});

}  // namespace burin
