// SPDX-License-Identifier: MIT
// Virtual coupling (Colgate, Stanley and Brown 1995; Adams and Hannaford 1999): the hand holds the virtual tool by a spring and a
// damper, so that whatever the world renders, the device never feels more stiffness than the coupling's.
//
// The virtual tool has no mass: it rests where the world's spring and the coupling balance. In series with a wall of stiffness k
// the device feels k Kc / (k + Kc). The coupling's damper acts between the hand and the virtual tool, which a stiff wall holds
// still; the effective damping is that of the series. Frame: device. Pure; no clock, heap, lock or throw.
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
