// SPDX-License-Identifier: MIT
#include "haptics/stability/virtual_coupling.hpp"

namespace burin {

CoupledWall through(const CouplingSettings& coupling, const CoupledWall& wall) noexcept {
    if (!(coupling.stiffness_N_per_m > 0.0)) return wall;
    return {wall.stiffness_N_per_m * coupling.stiffness_N_per_m / (wall.stiffness_N_per_m + coupling.stiffness_N_per_m),
            wall.damping_Ns_per_m};
}

}  // namespace burin
