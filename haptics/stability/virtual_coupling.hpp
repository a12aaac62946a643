// SPDX-License-Identifier: MIT
// Virtual coupling (Colgate, Stanley and Brown 1995; Adams and Hannaford 1999): the hand holds the virtual tool by a spring and a
// damper, so that whatever the world renders, the device never feels more stiffness than the coupling's.
//
// The virtual tool has no mass: it is where the wall (k, b) and the coupling (Kc, Bc) push equally,
//   k p + b p' = Kc (x - p) + Bc (x' - p').
// For the hand that is F(s) / x(s) = (k + b s)(Kc + Bc s) / (k + Kc + (b + Bc) s), whose first two terms in s are
//   stiffness k Kc / (k + Kc),   damping b (Kc / (k + Kc))^2 + Bc (k / (k + Kc))^2.
// They are what is rendered. It is what the tool would do up to about (k + Kc) / (b + Bc), some hundred rad/s or more for any
// wall that can be felt; above it the tool would follow the dampers' ratio instead, which one spring and one damper cannot show.
// Frame: device. Pure; no clock, heap, lock or throw.
#pragma once

#include "base/space.hpp"

namespace burin {

struct CouplingSettings {
    double stiffness_N_per_m = 0.0;  // Kc; 0: no coupling, the hand is the tool
    double damping_Ns_per_m = 0.0;   // Bc
};

struct CoupledWall {
    double stiffness_N_per_m = 0.0;
    double damping_Ns_per_m = 0.0;
};

// What the device feels of a wall through the coupling.
[[nodiscard]] CoupledWall through(const CouplingSettings& coupling, const CoupledWall& wall) noexcept;

}  // namespace burin
