// SPDX-License-Identifier: MIT
// How far a mesh is from the scene that it shall show: every figure of the benchmark's table, for Burin's meshes and for any
// other's alike. Nothing here knows how the mesh was made. Lengths in metres; the h of a name's end stands for the cell.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/scenes.hpp"
#include "compute/surface.hpp"
#include "geometry/triangle_mesh.hpp"

namespace burin::bench {

struct Spread {
    double rms = 0.0, max = 0.0;
    std::size_t samples = 0;
};

struct SurfaceErrors {
    double volume_over_removed = 0.0;  // (mesh - exact) over the removed volume
    // |f| at vertices and triangle centres, f = max(cube, -union): of the whole mesh, and of what lies within 0.02 m of the
    // union.
    Spread surface_m, cut_m;
    // From exact points to the mesh: on the cube's untouched edges and corners, where the union meets the faces, and (stamps
    // only) where two balls meet at more than 30 degrees.
    Spread edge_m, corner_m, rim_m, crease_m;
    bool has_creases = false;  // the scene is one of stamps
    std::size_t triangles = 0;
    std::size_t bad_edges = 0;  // open, non-manifold or wrongly oriented
};

// cell_m: the mesh's resolution; edges nearer than two cells to the union are not counted as untouched.
[[nodiscard]] SurfaceErrors measure(const TriangleMesh& mesh, const CarveScene& scene, double cell_m);

// The largest angle, rad, between a shading normal on the tool's surface and the exact one, away from rims and from where two
// sweeps meet. pi when one is turned inwards.
[[nodiscard]] double worst_normal_rad(const Surface& surface, const CarveScene& scene);

}  // namespace burin::bench
