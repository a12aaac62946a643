// SPDX-License-Identifier: MIT
// Repairs self-intersections of a welded surface. Dual contouring creates them where a cell's vertex, drawn to a sharp
// feature, jumps past a neighbour's (about one triangle in ten thousand around rims and thin walls).
//
// Local: only triangles within a few cells of a fault change. In rounds over a growing neighbourhood, each fault (a
// pair of intersecting triangles) is treated with the remedy that deviates least from the solid's surface: the other
// diagonal of a quad, or vertices moved by an eighth to all of the way towards a neighbour or the mean of their
// neighbours. A vertex stays in its cell, or moves back towards it; triangles are never added or removed; a remedy that
// leaves as many faults as before is not applied. The mesh stays closed and two-manifold. Serial except for the search
// for faults: the result does not depend on the number of threads.
// What 20,000 attempts do not repair (random noise has that many faults) is left as it is, and counted.
#pragma once

#include <cstdint>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

struct RepairReport {
    std::uint64_t found = 0;  // pairs of intersecting triangles before the repair
    std::uint64_t left = 0;   // pairs afterwards; found - left are repaired
    std::uint64_t diagonals_turned = 0;
    std::uint64_t vertices_moved = 0;
    std::vector<std::uint32_t> moved;  // indices of the moved vertices, in ascending order
    // The largest increase of a moved vertex's distance from a tangent plane that the solid's rays give around it.
    double deviation_max_m = 0.0;
};

// Repairs the mesh in place. It must be surface.welded(), and the surface up to date with the solid.
RepairReport repair_intersections(geometry::TriangleMesh& mesh, const Surface& surface, const Solid& solid,
                                  WorkerPool& pool);

}  // namespace burin::compute
