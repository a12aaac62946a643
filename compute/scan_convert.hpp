// SPDX-License-Identifier: MIT
// From a closed triangle mesh to a tri-dexel solid.
//
// Vertices are rounded to whole lattice units once; from then on whether a ray passes through a triangle is decided in
// 64-bit integers (ray_crossings.hpp), and every ray has an even number of crossings.
//
// Inside is where the winding number is above zero, so that overlapping shells unite and cavities stay. When the triangles
// of an edge are not oriented against each other the winding number means nothing; then inside is where the number of
// crossings so far is odd, and the result says so.
#pragma once

#include "base/worker_pool.hpp"
#include "compute/solid.hpp"

namespace burin {

struct ScanConversion {
    Solid solid;
    std::uint64_t crossings = 0;       // of rays with triangles
    std::uint64_t unmatched_rays = 0;  // whose crossings did not pair up; 0 for every closed mesh
    bool by_parity = false;            // the mesh is not consistently oriented
};

// The mesh's materials become the solid's. Fails on an empty mesh, coordinates that are not finite, a bad resolution, a mesh
// that is not closed, or one that encloses no ray.
[[nodiscard]] Result<ScanConversion> scan_convert(const TriangleMesh& mesh, int resolution, WorkerPool& pool);
// The same on a given lattice, which must hold the whole mesh.
[[nodiscard]] Result<ScanConversion> scan_convert_onto(const TriangleMesh& mesh, const Lattice& lattice,
                                                       WorkerPool& pool);

// Only what triangles use counts: a stray vertex must not stretch a lattice.
[[nodiscard]] Box bounds_of_triangles(const TriangleMesh& mesh);

}  // namespace burin
