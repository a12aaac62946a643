// SPDX-License-Identifier: MIT
// How stiff a wall may be on a device before the sampled spring gives out more energy than the device takes away.
//
// The promise: as long as the tool moves no faster in the wall than the contact speed V it is meant for, at every moment
//
//   work of the wall on hand and device since the contact began  <=  what the device's friction and damping took since then
//
// (with virtual damping: since a velocity window before it, for a damper remembers the approach), so the hand alone decides
// what energy there is. It holds for every motion, every hand and every mass; tests/haptics/passivity_prop.cpp tries it on random
// ones. It is for one point: the stiffnesses of points that touch at once add up.
//
// Where it comes from. A spring of stiffness K whose force is sampled every T and held, and acts t_d (in whole periods) and a
// filter's mean lag t_f late, is behind its own potential K x^2 / 2 by at most
//     K (T/2 + t_d + t_f) v^2 dt  +  K D/2 |v| dt
// in a time dt at speed v, D the encoder's step, rounded to nearest. (With x(t) - x(t - tau) written as an integral, the product
// of two speeds bounded by half the sum of their squares, and the lags summed up over a period. A filter is a mixture of
// delays, clamps and the one-sided wall only make the spring's slope less, so neither changes this.) The device takes
// b v^2 dt + c |v| dt. A damper whose speed is an average of differences gives out at most B (V + D/T) |v| dt.
// All is linear in |v|, so it needs to hold at rest and at V only:
//     rest       K D/2                                + B (V + D/T)  <=  c
//     speed      K ((T/2 + t_d + t_f) V + D/2)        + B (V + D/T)  <=  c + b V
// or, at any speed at all, by damping alone, 2.2 being the worst case for adaptive windows of up to 16 periods (1 for a plain
// difference, which is Colgate and Schenkel's b > K T/2 + |B|; with delay Diolaiti, Niemeyer, Barbagli and Salisbury 2006 and
// Hulin, Albu-Schaeffer and Hirzinger 2013):
//     rest       K D/2                                + B D/T        <=  c      where c is known
//     speed      K (T/2 + t_d + t_f)                  + 2.2 B        <=  b
// Either pair is enough. The rest lines without B are Abbott and Okamura's K <= 2 c / D (2005); the friction's part at a speed is
// Diolaiti's c / v. What is not known of a device is 0 and takes nothing away; where neither friction nor damping is known, only
// the maker's stiffness rules.
//
// What gives way first is the virtual damping: a wall is told from a softer one by its stiffness. Pure; no clock, heap, lock or
// throw.
#pragma once

#include <cstdint>

#include "devices/haptic_device.hpp"

namespace burin {

// What bears on the limit most; the reason to show.
enum class StiffnessBound : std::uint8_t {
    none,      // the wanted stiffness and damping are within all bounds
    sampling,  // damping and friction of the device against sampling and delay, at the contact speed it is meant for
    quantisation,  // Coulomb friction against the encoder's step: K <= 2 f_c / D
    device,        // what the device's maker says
    damping,       // the stiffness is kept; the virtual damping asked for is more than the device can take away
};

struct StiffnessLimit {
    double stiffness_N_per_m = 0.0;  // the wanted one, or the most that is allowed
    double damping_Ns_per_m = 0.0;   // likewise
    StiffnessBound bound = StiffnessBound::none;
};

struct ContactDemand {
    double stiffness_N_per_m = 0.0;
    double damping_Ns_per_m = 0.0;
    // The fastest motion in the wall that shall be passive. A deliberate tap arrives at 0.1 m/s; this is half as much
    // again, and the most at which the Omni bears the default material (600 N/m, 0.5 Ns/m) whole. Beyond it the passivity
    // controller takes back what is given out too much (haptics/stability/passivity.hpp).
    double contact_speed_m_per_s = 0.15;
    double filter_lag_s = 0.0;  // mean lag of a filter on the force: counts as delay
    double period_s = 0.0;      // of the loop; 0: the device's own rate
};

// Nothing in the demand is negative, all is finite.
[[nodiscard]] StiffnessLimit limited(const ContactDemand& wanted, const DeviceDescription& device) noexcept;

// A sentence for people, of static storage.
[[nodiscard]] const char* text(StiffnessBound bound) noexcept;

}  // namespace burin
