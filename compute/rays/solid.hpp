// SPDX-License-Identifier: MIT
// The tri-dexel solid in host memory: a lattice, three sets of rays, and the table of materials to which their ends
// refer.
// Meshing takes its signs from the rays along z; the other two sets add the points where the surface crosses their
// rays.
#pragma once

#include <array>
#include <vector>

#include "base/error.hpp"
#include "compute/rays/dexel_set.hpp"
#include "compute/rays/lattice.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::compute {

struct Solid {
    Lattice lattice;
    std::array<DexelSet, 3> sets;               // along x, y, z
    std::vector<geometry::Material> materials;  // at most 255

    [[nodiscard]] std::size_t rays_held() const {
        return sets[0].ray_count() + sets[1].ray_count() + sets[2].ray_count();
    }
    [[nodiscard]] std::size_t bytes() const { return sets[0].bytes() + sets[1].bytes() + sets[2].bytes(); }
    [[nodiscard]] bool same_content(const Solid& other) const {
        return lattice == other.lattice && sets[0].same_content(other.sets[0]) && sets[1].same_content(other.sets[1]) &&
               sets[2].same_content(other.sets[2]);
    }
};

// Returns whether every ray has sorted, strictly increasing depths within the lattice, an even number of ends, and only
// materials that are in the table.
[[nodiscard]] bool well_formed(const Solid& solid);

// Returns the material's index in the solid's table, to which it is added if missing. Fails when the table is full.
[[nodiscard]] Result<std::uint8_t> add_material(Solid& solid, const geometry::Material& material);

// Makes an axis-aligned block of the given size whose lowest corner is the object origin.
[[nodiscard]] Result<Solid> make_block(const Vec3& size_m, int resolution, geometry::Material material);
// Makes a ball about the object origin.
[[nodiscard]] Result<Solid> make_ball(double radius_m, int resolution, geometry::Material material);

}  // namespace burin::compute
