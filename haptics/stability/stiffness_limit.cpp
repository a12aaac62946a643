// SPDX-License-Identifier: MIT
#include "haptics/stability/stiffness_limit.hpp"

namespace burin {

StiffnessLimit limited(const ContactDemand& wanted, const DeviceDescription&) noexcept {
    return {wanted.stiffness_N_per_m, wanted.damping_Ns_per_m, StiffnessBound::none};
}

const char* text(StiffnessBound) noexcept { return ""; }

}  // namespace burin
