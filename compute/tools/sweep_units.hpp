// SPDX-License-Identifier: MIT
// From a sweep in metres to capsules in whole lattice units.
#pragma once

#include <span>
#include <vector>

#include "compute/engine.hpp"
#include "shaders/shared/capsule.h"

namespace burin {

// The capsules of the sweeps that come near the lattice, in order; the others touch nothing and are left out. A segment that
// leaves the lattice by more than the radius is clipped there, so that coordinates stay within the exact arithmetic's range;
// what is clipped off could not reach any ray. Fails on a number that is not finite, and on a radius that is not above zero
// or is larger than 4096 cells, a position so far away that doubles no longer tell units apart, or a material that the
// solid does not have.
[[nodiscard]] Result<std::vector<shared::Capsule>> capsules_in_units(const Solid& solid,
                                                                     std::span<const BallSweep> sweeps);

// The rays of one axis that a capsule can touch: u_lo..u_hi, v_lo..v_hi inclusive; empty when lo > hi.
struct Footprint {
    int u_lo, u_hi, v_lo, v_hi;
    [[nodiscard]] bool empty() const { return u_lo > u_hi || v_lo > v_hi; }
    [[nodiscard]] bool holds(int u, int v) const { return u >= u_lo && u <= u_hi && v >= v_lo && v <= v_hi; }
};
[[nodiscard]] Footprint footprint(const Lattice& lattice, const shared::Capsule& capsule, int axis);

}  // namespace burin
