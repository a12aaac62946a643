// SPDX-License-Identifier: MIT
// The wall that the device renders for a material: through the virtual coupling (first part), and no stiffer than what
// it renders passively (second part).
//
// Virtual coupling (Colgate, Stanley and Brown 1995; Adams and Hannaford 1999): a spring and a damper between the hand
// and the virtual tool, so that whatever the world renders, the device never feels more stiffness than the coupling's.
//
// The virtual tool has no mass: it is where the wall (k, b) and the coupling (Kc, Bc) balance,
//   k p + b p' = Kc (x - p) + Bc (x' - p').
// For the hand that is F(s) / x(s) = (k + b s)(Kc + Bc s) / (k + Kc + (b + Bc) s), whose first two terms in s are
//   stiffness k Kc / (k + Kc),   damping b (Kc / (k + Kc))^2 + Bc (k / (k + Kc))^2.
// These are rendered. They match the tool's motion up to about (k + Kc) / (b + Bc), some hundred rad/s or more for any
// wall that can be felt; above it the tool would follow the dampers' ratio instead, which one spring and one damper
// cannot render.
//
// The greatest stiffness of a wall on a device for which the sampled spring gives out no more energy than the device
// dissipates.
//
// The promise: as long as the tool moves no faster in the wall than the contact speed V it is meant for, at every
// moment
//
//   work of the wall on hand and device since contact began  <=  energy dissipated by friction and damping since then
//
// (with virtual damping: since a velocity window before it, for a damper remembers the approach), so only the hand puts
// energy in. It holds for every motion, every hand and every mass; tests/haptics/passivity_prop.cpp tries it on random
// ones. It is for one point: the stiffnesses of points that touch at once add up, and so do their torsional
// stiffnesses, the stiffness times the square of the arm, for which the same conditions hold in angular units.
//
// Derivation. A spring of stiffness K whose force is sampled every T and held, and acts t_d (in whole periods) and a
// filter's mean lag t_f late, lags its own potential K x^2 / 2 by at most
//     K (T/2 + t_d + t_f) v^2 dt  +  K D/2 |v| dt
// in a time dt at speed v, D the encoder's step, rounded to nearest. (Write x(t) - x(t - tau) as an integral, bound the
// product of two speeds by half the sum of their squares, and sum the lags over a period. A filter is a mixture of
// delays; clamps and the one-sided wall only reduce the spring's slope; so neither changes this.) The device dissipates
// b v^2 dt + c |v| dt. A damper whose speed is an average of differences gives out at most B (V + D/T) |v| dt.
// All is linear in |v|, so it needs to hold at rest and at V only:
//     rest       K D/2                                + B (V + D/T)  <=  c
//     speed      K ((T/2 + t_d + t_f) V + D/2)        + B (V + D/T)  <=  c + b V
// or, at any speed at all, by damping alone, 2.2 being the worst case for adaptive windows of up to 16 periods (1 for a
// plain difference, which is Colgate and Schenkel's b > K T/2 + |B|; with delay Diolaiti, Niemeyer, Barbagli and
// Salisbury 2006 and Hulin, Albu-Schaeffer and Hirzinger 2013):
//     rest       K D/2                                + B D/T        <=  c      where c is known
//     speed      K (T/2 + t_d + t_f)                  + 2.2 B        <=  b
// Either pair is enough. The rest lines without B are Abbott and Okamura's K <= 2 c / D (2005); the friction's part at
// a speed is Diolaiti's c / v. An unknown figure of a device is 0 and counts as no dissipation; where neither friction
// nor damping is known, only the maker's stiffness limit applies.
//
// Virtual damping is reduced before stiffness: people tell walls apart by their stiffness. Pure; no clock, heap, lock
// or throw.
#pragma once

#include <cstdint>

#include "devices/haptic/haptic_device.hpp"
#include "haptics/stability/coupled_wall.hpp"
#include "haptics/stability/passivity_settings.hpp"

namespace burin::haptics {

// ---- Virtual coupling

// The wall as the device feels it through the coupling.
[[nodiscard]] CoupledWall through(const VirtualCoupling& coupling, const CoupledWall& wall) noexcept;

// ---- Stiffness limit

struct StiffnessLimit {
    double stiffness_N_per_m = 0.0;  // the desired stiffness, or the greatest that is allowed
    double damping_Ns_per_m = 0.0;   // likewise
    StiffnessBound bound = StiffnessBound::none;
};

struct ContactDemand {
    double stiffness_N_per_m = 0.0;
    double damping_Ns_per_m = 0.0;
    double contact_speed_m_per_s = kContactSpeed_m_per_s;
    double filter_lag_s = 0.0;  // mean lag of a filter on the force; counts as delay
    double period_s = 0.0;      // of the loop; 0: the device's own rate
};

// Limits the desired stiffness and damping. Requires a finite, non-negative demand.
[[nodiscard]] StiffnessLimit limited(const ContactDemand& wanted, const devices::DeviceDescription& device) noexcept;

// The same for rotation about the device's position. Walls of stiffness k touched at the arms r_i resist rotation with
// at most k sum(r_i^2), likewise damping. Returns the stiffness and damping of each of these walls; those that are
// wanted
// where the device gives no torque, or where nothing is known of its rotation.
[[nodiscard]] StiffnessLimit limited_by_rotation(const ContactDemand& wall, double sum_of_squared_arms_m2,
                                                 const devices::DeviceDescription& device) noexcept;

// ---- What is rendered of a material

// The wall that a point asks of its device, and what acts beside it.
struct WallDemand {
    CoupledWall wall;              // of the material
    VirtualCoupling coupling;      // through which it is felt
    double points = 1.0;           // how many such walls act side by side
    double squared_arms_m2 = 0.0;  // sum over these points; 0: they do not turn the tool
    double filter_lag_s = 0.0;     // as in ContactDemand
    double period_s = 0.0;
    bool limit = true;  // false: as asked, through the coupling
};

struct RenderedWall {
    CoupledWall wall;
    StiffnessBound bound = StiffnessBound::none;  // why it is less than asked
};

// The wall as the device may render it: through the coupling, and limited to what stays passive. What acts side by side
// shares the limit, and so does the resistance to rotation that it makes up together.
[[nodiscard]] RenderedWall rendered(const WallDemand& demand, const devices::DeviceDescription& device) noexcept;

}  // namespace burin::haptics
