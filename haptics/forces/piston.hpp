// SPDX-License-Identifier: MIT
// The force of a piston: what a glove that drives each fingertip by one piston displays of the forces of its points.
//
//   P = |F| / cos(theta),  F = sum of F_m
//
// (Popescu, Burdea and Bouzit, Virtual Reality Simulation Modeling for a Haptic Glove, section 3.2, for the Rutgers
// Master II.) theta is the angle between F and the piston's axis, which leads from its foot to the fingertip. The
// piston gives what has the component |F| along F. So a wall of stiffness k is as stiff along the piston, however it is
// tilted: moved by x along the axis the tip is x cos(theta) deep, F is k x cos(theta), and P is k x.
//
// Near 90 degrees the rule asks for more than any piston gives, and beyond for a pull. Here
//
//   P = F . a / max(cos(theta), c)^2    where cos(theta) > 0, else 0;  a unit, along the axis
//
// which is the rule where cos(theta) >= c, never exceeds |F| / c, and falls to 0 at 90 degrees without a step. Each
// departure from the rule has a name. A zero force gives zero, and so does an axis of length zero, which has no
// direction. What is not finite stays so, for the gate to find (stability/safety_gate.hpp).
//
// The rule comes before filter, energy account and gate: these see what the hand is to feel. A hand that a piston moves
// along one line only can move along others by itself, deeper into a tilted wall without resistance, and the piston
// would then do work that nobody put in; the energy account keeps that from the hand.
// Frame: any, the same for both vectors. Pure; no clock, heap, lock or throw.
#pragma once

#include <cstdint>

#include "base/space.hpp"
#include "devices/haptic/haptic_device.hpp"

namespace burin::haptics {

// Why a piston's force is not |F| / cos(theta).
enum class PistonBound : std::uint8_t {
    none,
    near_square,  // cos(theta) is above 0 and below the least cosine: P is less
    pull,         // the force draws the tip towards the foot, which a piston cannot: P is 0
    no_axis,      // the tip is at the foot, and there is no direction: P is 0
};

struct PistonForce {
    Vec3 force_N{0.0};  // P a
    // P / (F . a), by which the springs of the wall hold more energy as felt along the axis; 0 where P is.
    double gain = 0.0;
    PistonBound bound = PistonBound::none;
};

struct PistonSettings {
    // c, above 0, at most 1: the rule holds up to 75.5 degrees, and gives at most four times |F|. A hand that moves
    // across the piston feels k tan(theta), which is 3.9 k there.
    double least_cosine = 0.25;
};

// Maps the sum of the points' forces to the piston's; `along` leads from the foot to the tip and may have any length.
[[nodiscard]] PistonForce piston_force(const Vec3& force_N, const Vec3& along,
                                       const PistonSettings& settings = {}) noexcept;

// The part of a force that pushes the position away from the piston's foot, which is what a piston can give of forces
// that are no contact's, such as guidance; all of the force where no piston drives the device.
[[nodiscard]] Vec3 pushed_part(const Vec3& force_N, const devices::Piston& piston,
                               const Vec3& position_device_m) noexcept;

// A sentence for people; static storage.
[[nodiscard]] const char* text(PistonBound bound) noexcept;

}  // namespace burin::haptics
