// SPDX-License-Identifier: MIT
// Self-intersections of a mesh: pairs of triangles that meet other than in the vertices and the edge they share
// (geometry/mesh/triangle_contact.hpp); how to find them, and how to repair those of a welded surface.
// No result depends on the number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

using TrianglePair = std::array<std::uint32_t, 2>;  // indices of triangles, the lower first

// Returns the pairs in ascending order. Exact: no pair is missed and none is reported falsely. Triangles with a
// repeated vertex are skipped. Cost: about n log n; one second for a million triangles on one core.
[[nodiscard]] std::vector<TrianglePair> self_intersections(const geometry::TriangleMesh& mesh, WorkerPool& pool);

struct RepairReport {
    std::uint64_t found = 0;  // pairs of intersecting triangles before the repair
    std::uint64_t left = 0;   // pairs afterwards; found - left are repaired
    std::uint64_t diagonals_turned = 0;
    std::uint64_t vertices_moved = 0;
    std::vector<std::uint32_t> moved;  // indices of the moved vertices, in ascending order
    // The largest increase of a moved vertex's distance from a tangent plane that the solid's rays give around it.
    double deviation_max_m = 0.0;
};

// Repairs the mesh in place. It must be surface.welded(unit), and the surface up to date with the solid. Dual
// contouring creates self-intersections where a cell's vertex, drawn to a sharp feature, jumps past a neighbour's
// (about one triangle in ten thousand around rims and thin walls).
//
// Local: only triangles within a few cells of a fault change. In rounds over a growing neighbourhood, each fault (a
// pair of intersecting triangles) is treated with the remedy that deviates least from the solid's surface: the other
// diagonal of a quad, or vertices moved by an eighth to all of the way towards a neighbour or the mean of their
// neighbours. A vertex stays in its cell, or moves back towards it; triangles are never added or removed; a remedy that
// leaves as many faults as before is not applied. The mesh stays closed and two-manifold. Serial except for the search
// for faults.
// What 20,000 attempts do not repair (random noise has that many faults) is left as it is, and counted.
RepairReport repair_intersections(geometry::TriangleMesh& mesh, const Surface& surface, const Solid& solid,
                                  WorkerPool& pool, LengthUnit unit = LengthUnit::m);

}  // namespace burin::compute
