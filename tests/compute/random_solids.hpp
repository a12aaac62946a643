// SPDX-License-Identifier: MIT
// Solids that no sculptor would make: noise on the lattice, with rays that agree or disagree about it.
#pragma once

#include "compute/rays/solid.hpp"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {

enum class Rays {
    agree,      // every direction has its ends on the lattice edges where the signs change
    disturbed,  // in x and y some ends are moved, by up to several cells, and some intervals are gone
    unrelated,  // x and y rays come from other noise altogether
};

// Every inner node is inside with probability p; the outermost layer of nodes is outside. Ends have random depths
// within their edge, random normals and one of two materials.
[[nodiscard]] Solid noise_solid(const std::array<int, 3>& cells, double p, Rays rays, std::uint64_t seed);

}  // namespace burin::compute::test
