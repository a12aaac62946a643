// SPDX-License-Identifier: MIT
// Surfaces that are rough: a mesh whose vertices lie anywhere near a bumpy sphere, and the tiles of a carved noise.
#pragma once

#include "compute/mesher/surface.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/haptics/smooth_shapes.hpp"

namespace burin::haptics::test {

// A bumpy sphere of 100 mm whose vertices are moved by up to `roughness` mean edges.
inline Surface rough_ball(int subdivisions, double roughness, std::uint64_t seed) {
    geometry::TriangleMesh mesh = mesh_of({.radius_m = 0.05, .bump_m = 0.001}, subdivisions);
    const double edge = touchable(mesh)->mean_edge_m();
    compute::test::Random random(seed);
    for (Vec3& p : mesh.positions_m)
        p += roughness * edge * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    return touchable(mesh);
}

inline Surface noise_tiles() {
    static WorkerPool pool(2);
    const compute::Solid solid = compute::test::noise_solid({20, 20, 20}, 0.4, compute::test::Rays::agree, 4);
    compute::Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    auto local = std::make_unique<geometry::LocalSurface>();
    compute::gather_local_surface(surface, solid.lattice.origin_object + 10.0 * solid.lattice.spacing_m, 1e3, *local);
    local->sequence = 1;
    return local;
}

}  // namespace burin::haptics::test
