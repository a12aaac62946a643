// SPDX-License-Identifier: MIT
// Measures how far a mesh is from the scene that it represents: every figure of the benchmark's table, alike for
// Burin's meshes and any other's. Nothing here depends on how the mesh was made. Lengths in metres; an h at the end of
// a name stands for the cell.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/measure/scenes.hpp"
#include "compute/mesher/surface.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

struct Spread {
    double rms = 0.0, max = 0.0;
    std::size_t samples = 0;
};

struct SurfaceErrors {
    // Set where the workpiece is the cube, turned or not. Of other workpieces only surface_m, cut_m and the counts are
    // measured.
    bool of_cube = true;
    double volume_over_removed = 0.0;  // (mesh - exact) over the removed volume
    // |f| at vertices and triangle centres, f = max(cube, -union): of the whole mesh, and of the part within 0.02 m of
    // the union. For other workpieces a lower bound: the distance to the nearer of the workpiece's surface and the
    // union's.
    Spread surface_m, cut_m;
    // Distances from exact points to the mesh: on the cube's untouched edges and corners, where the union meets the
    // faces, and (stamps only) where two balls meet at more than 30 degrees.
    Spread edge_m, corner_m, rim_m, crease_m;
    bool has_creases = false;  // the scene consists of stamps
    std::size_t triangles = 0;
    std::size_t bad_edges = 0;  // open, non-manifold or wrongly oriented
};

// Takes a mesh in the object frame. cell_m is the mesh's resolution; edges nearer than two cells to the union do not
// count as untouched.
[[nodiscard]] SurfaceErrors measure(const geometry::TriangleMesh& mesh_object, const CarveScene& scene, double cell_m);

// Returns the largest angle, rad, between a shading normal on the tool's surface and the exact one, away from rims and
// from where two sweeps meet; pi if a normal points inwards.
[[nodiscard]] double worst_normal_rad(const compute::Surface& surface, const CarveScene& scene);

}  // namespace burin::bench
