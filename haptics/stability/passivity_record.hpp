// SPDX-License-Identifier: MIT
// What a tick keeps of the passivity observer and controller (haptics/stability/passivity.hpp). Plain data.
#pragma once

#include <cmath>

namespace burin::haptics {

// What the controller saw and did in a tick.
struct PassivityRecord {
    double energy_J = 0.0;          // E(n), put into the rendered world since contact began, before the controller acts
    double budget_J = 0.0;          // A(n) of the account: what the world may still give out, for certain
    double damping_Ns_per_m = 0.0;  // a; 0: no damping is added
    double share = 1.0;             // of the wrench: less than 1 where the account affords no more
    double most_N = HUGE_VAL;       // the greatest force that the account affords
    double most_Nm = HUGE_VAL;      // the greatest torque beside it
};

}  // namespace burin::haptics
