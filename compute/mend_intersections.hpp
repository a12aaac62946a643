// SPDX-License-Identifier: MIT
// Mends the places where a welded surface passes through itself. Dual contouring does that where a cell's vertex, drawn to
// a sharp feature, jumps past a neighbour's (about one triangle in ten thousand around rims and thin walls).
//
// Local: only triangles within a few cells of a fault change. In rounds over a neighbourhood that grows, each fault is cured
// by the remedy that moves the surface least: the other diagonal of a quad, or vertices moved towards the middle of their
// neighbours by a quarter, a half, three quarters or all of the way. A vertex never leaves the lattice cell that it lies in; triangles are never added or removed; a remedy that leaves as many faults as before is not taken. The mesh stays
// closed and two-manifold. Serial but for finding the faults: the result does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/solid.hpp"

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

// The mesh must be Surface::welded()'s of a surface of this solid.
MendingReport mend_intersections(TriangleMesh& mesh, const Solid& solid, WorkerPool& pool);

}  // namespace burin
