// SPDX-License-Identifier: MIT
// Mends the places where a welded surface passes through itself. Dual contouring does that where a cell's vertex, drawn to
// a sharp feature, jumps past a neighbour's (about one triangle in ten thousand around rims and thin walls).
//
// Local: only triangles within a few cells of a fault change. In rounds over a neighbourhood that grows, each fault is cured
// by the remedy that leaves the solid's surface least: the other diagonal of a quad, or vertices moved by an eighth to all of
// the way towards a neighbour or the middle of their neighbours. A vertex stays in its cell, or goes back there;
// triangles are never added or removed; a remedy that leaves as many faults as before is not taken. The mesh stays closed
// and two-manifold. Serial but for finding the faults: the result does not depend on the number of threads.
// What 20,000 attempts do not mend (random noise has that many faults) is left, and counted.
#pragma once

#include <cstdint>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/solid.hpp"
#include "compute/surface.hpp"

namespace burin {

struct MendingReport {
    std::uint64_t found = 0;  // pairs of triangles that met where they should not
    std::uint64_t left = 0;   // of those that are there now; found - left are mended
    std::uint64_t diagonals_turned = 0;
    std::uint64_t vertices_moved = 0;
    std::vector<std::uint32_t> moved;  // which, in ascending order
    // How much farther than before a moved vertex lies from a plane that the solid's rays give around it; the largest.
    double deviation_max_m = 0.0;
};

// The mesh must be surface.welded(), and the surface up to date with the solid.
MendingReport mend_intersections(TriangleMesh& mesh, const Surface& surface, const Solid& solid, WorkerPool& pool);

}  // namespace burin
