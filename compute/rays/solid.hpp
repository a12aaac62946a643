// SPDX-License-Identifier: MIT
// The tri-dexel solid on the host: a lattice, three sets of rays, and the table of materials its ends refer to.
// The signs that meshing uses come from the rays along z; the other two sets add where surfaces cross their rays.
#pragma once

#include <array>
#include <vector>

#include "base/error.hpp"
#include "compute/dexel_set.hpp"
#include "compute/lattice.hpp"
#include "geometry/triangle_mesh.hpp"

namespace burin {

struct Solid {
    Lattice lattice;
    std::array<DexelSet, 3> sets;     // along x, y, z
    std::vector<Material> materials;  // at most 255

    [[nodiscard]] std::size_t rays_held() const {
        return sets[0].ray_count() + sets[1].ray_count() + sets[2].ray_count();
    }
    [[nodiscard]] std::size_t bytes() const { return sets[0].bytes() + sets[1].bytes() + sets[2].bytes(); }
    [[nodiscard]] bool same_content(const Solid& other) const {
        return lattice == other.lattice && sets[0].same_content(other.sets[0]) && sets[1].same_content(other.sets[1]) &&
               sets[2].same_content(other.sets[2]);
    }
};

// Every ray of a solid has sorted, strictly increasing depths within the lattice and matched ends.
[[nodiscard]] bool well_formed(const Solid& solid);

// The material's number in the solid's table, where it is put unless it is there already. Fails when the table is full.
[[nodiscard]] Result<std::uint8_t> add_material(Solid& solid, const Material& material);

// An axis-aligned block of the given size whose lowest corner is the object origin.
[[nodiscard]] Result<Solid> make_block(const Vec3& size_m, int resolution, Material material);
// A ball about the object origin.
[[nodiscard]] Result<Solid> make_ball(double radius_m, int resolution, Material material);

}  // namespace burin
