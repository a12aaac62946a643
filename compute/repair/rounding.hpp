// SPDX-License-Identifier: MIT
// Repairs what rounding to a file's single-precision numbers has done to a mesh: triangles as narrow as the rounding
// turn over and pass through their neighbours. Unlike repair_intersections() it knows no solid, and moves vertices by
// single steps of a float only. Thread: any; no result depends on the number of threads.
#pragma once

#include <cstdint>
#include <functional>

#include "base/worker_pool.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute {

struct RoundingReport {
    std::uint64_t found = 0, left = 0;  // pairs that meet by rounding alone, before and after the repair
    std::uint64_t vertices_moved = 0;
    std::uint64_t tests = 0;  // comparisons of boxes and triangles: the work done
    bool complete = true;     // false: the bound on the work was met, and pairs may be left that nobody has seen
};

// Moves vertices of the rounded mesh, whose positions are floats, by at most a few steps along each axis, where that
// leaves fewer pairs of intersecting triangles. Vertices at one position stay together, and different positions
// different. `exact` is the mesh before rounding, in any unit: of the same triangles, with vertices at one position
// where the rounded mesh has them there. `show` is called with the progress from 0 to 1 and may be empty.
// Only pairs that rounding can bring together are looked at (near_pairs.hpp), and vertices of small fans are moved
// only. Cost: about n log n for the search; for the repair at most kMostRepairTests and kRepairTestsATriangle for each
// triangle.
inline constexpr std::uint64_t kMostRepairTests = 500'000, kRepairTestsATriangle = 1;
[[nodiscard]] RoundingReport repair_rounding(const geometry::TriangleMesh& exact, geometry::TriangleMesh& rounded,
                                             WorkerPool& pool, const std::function<void(double)>& show = {});

}  // namespace burin::compute
