// SPDX-License-Identifier: MIT
// The grip: the spring, the damper and the mass with which a hand holds the stylus.
//
// F = K (target - p) + B (d target/dt - p') plus the hand's mass on the stylus. Mass and damping are of the
// size of a hand tapping a wall (0.1 kg, 3 Ns/m, 100 N/m). A hand that follows a path holds more firmly: the Omni's
// 0.26 N of friction alone would leave it 2.6 mm behind at 100 N/m. With 200 N/m that is 1.3 mm, and 6 Ns/m makes the
// 145 g of hand and stylus settle (damping ratio 0.56). So a slow path is followed within 2 mm in free air, and a
// target 5 mm behind a wall's surface presses the wall with about 1 N.
#pragma once

#include "base/space.hpp"

namespace burin::devices {

// In rotation likewise, for devices whose handle turns under torque (a wand, not a stylus): T = K_r turn + B_r (w
// target - w), with a fist's inertia. 2 Nm/rad is about a wrist's own stiffness: the 0.23 Nm that a wand gives turn it
// by 0.1 rad. 0.05 Nms/rad makes fist and handle settle (damping ratio 0.46).
struct HandGrip {
    double mass_kg = 0.1;
    double stiffness_N_per_m = 200.0;
    double damping_Ns_per_m = 6.0;
    double inertia_kgm2 = 0.001;
    double torsion_Nm_per_rad = 2.0;
    double angular_damping_Nms_per_rad = 0.05;
};

// Returns whether every number of a grip is finite and not negative.
[[nodiscard]] inline bool is_sensible(const HandGrip& grip) noexcept {
    return not_negative(grip.mass_kg) && not_negative(grip.stiffness_N_per_m) && not_negative(grip.damping_Ns_per_m) &&
           not_negative(grip.inertia_kgm2) && not_negative(grip.torsion_Nm_per_rad) &&
           not_negative(grip.angular_damping_Nms_per_rad);
}

}  // namespace burin::devices
