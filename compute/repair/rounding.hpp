// SPDX-License-Identifier: MIT
// Repairs what rounding to a file's single-precision numbers has done to a mesh: triangles as narrow as the rounding
// turn over and pass through their neighbours. Unlike repair_intersections() it knows no solid, and moves vertices by
// single steps of a float only. Thread: any; no result depends on the number of threads.
#pragma once

#include <cstdint>

#include "base/worker_pool.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute {

struct RoundingReport {
    std::uint64_t before = 0;           // pairs of triangles that met before the mesh was rounded
    std::uint64_t found = 0, left = 0;  // pairs that meet in the rounded mesh, before and after the repair
    std::uint64_t vertices_moved = 0;
};

// Moves vertices of the rounded mesh, whose positions are floats, by at most a few steps along each axis, where that
// leaves fewer pairs of intersecting triangles. Vertices at one position stay together, and different positions
// different. `exact` is the mesh before rounding, in any unit. Cost: that of two searches for intersections.
[[nodiscard]] RoundingReport repair_rounding(const geometry::TriangleMesh& exact, geometry::TriangleMesh& rounded,
                                             WorkerPool& pool);

}  // namespace burin::compute
