// SPDX-License-Identifier: MIT
#include "haptics/stability/virtual_coupling.hpp"

namespace burin {

CoupledWall through(const CouplingSettings& coupling, const CoupledWall& wall) noexcept {
    if (!(coupling.stiffness_N_per_m > 0.0)) return wall;
    const double sum = wall.stiffness_N_per_m + coupling.stiffness_N_per_m;
    const double of_wall = coupling.stiffness_N_per_m / sum;  // the share of the motion that the wall yields
    const double of_coupling = wall.stiffness_N_per_m / sum;  // and the coupling
    return {wall.stiffness_N_per_m * of_wall,
            wall.damping_Ns_per_m * of_wall * of_wall + coupling.damping_Ns_per_m * of_coupling * of_coupling};
}

}  // namespace burin
