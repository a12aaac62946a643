// SPDX-License-Identifier: MIT
// Conversion of ball sweeps in metres to capsules in whole lattice units.
#pragma once

#include <span>
#include <vector>

#include "compute/rays/solid.hpp"
#include "compute/tools/ball_sweep.hpp"
#include "shaders/shared/capsule.h"

namespace burin::compute {

// Returns the capsules of those sweeps that come near the lattice, in order. A segment that leaves the lattice by more
// than the radius is clipped there, so that coordinates stay in the range of the exact arithmetic; the part clipped off
// could not reach any ray. Fails on a number that is not finite, a radius that is not above zero or is larger than 4096
// cells, a position so far away that doubles no longer resolve lattice units, a material that the solid does not have,
// or the operation smooth.
[[nodiscard]] Result<std::vector<shared::Capsule>> capsules_in_units(const Solid& solid,
                                                                     std::span<const BallSweep> sweeps);

// The rays of one axis that a tool can touch: u_lo..u_hi, v_lo..v_hi, inclusive; empty when lo > hi.
struct Footprint {
    int u_lo, u_hi, v_lo, v_hi;
    [[nodiscard]] bool empty() const { return u_lo > u_hi || v_lo > v_hi; }
    [[nodiscard]] bool holds(int u, int v) const { return u >= u_lo && u <= u_hi && v >= v_lo && v <= v_hi; }
};
[[nodiscard]] Footprint footprint(const Lattice& lattice, const shared::Capsule& capsule, int axis);
// The rays that may meet something within these bounds, in lattice units.
[[nodiscard]] Footprint footprint(const Lattice& lattice, const Box& bounds, int axis);

}  // namespace burin::compute
