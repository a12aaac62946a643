// SPDX-License-Identifier: MIT
// Scan conversion of a closed triangle mesh to a tri-dexel solid.
//
// Vertices are rounded to whole lattice units once; after that, whether a ray passes through a triangle is decided in
// 64-bit integers (ray_crossings.hpp), and every ray has an even number of crossings.
//
// A depth is inside where the winding number is above zero, so that overlapping shells are united and cavities are
// kept. When the triangles at an edge are not oriented consistently, the winding number is meaningless; a depth is then
// inside where the number of crossings so far is odd, and ScanConversion::by_parity is set.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

struct ScanConversion {
    Solid solid;
    std::uint64_t crossings = 0;       // between rays and triangles
    std::uint64_t unmatched_rays = 0;  // rays whose crossings did not pair up; 0 for every closed mesh
    bool by_parity = false;            // set when the mesh is not consistently oriented
};

// Converts the mesh on a lattice of its own; its materials become those of the solid. Fails on an empty mesh,
// coordinates that are not finite, an invalid resolution, a mesh that is not closed, or one that encloses no ray.
[[nodiscard]] Result<ScanConversion> scan_convert(const geometry::TriangleMesh& mesh, int resolution, WorkerPool& pool);
// Converts the mesh on a given lattice, which must hold the whole mesh.
[[nodiscard]] Result<ScanConversion> scan_convert_onto(const geometry::TriangleMesh& mesh, const Lattice& lattice,
                                                       WorkerPool& pool);

}  // namespace burin::compute
