// SPDX-License-Identifier: MIT
// What the passivity observer and controller (haptics/stability/passivity.hpp) are told, and the speeds up to which
// walls are promised to be passive (haptics/stability/rendered_wall.hpp). Plain data.
#pragma once

#include <cstdint>

namespace burin::haptics {

// The fastest motion in the wall for which passivity is promised. A deliberate tap arrives at 0.1 m/s; this is half
// as much again, and the most at which the Omni renders the default material (600 N/m, 0.5 Ns/m) in full. Beyond it
// the passivity controller removes the excess energy (haptics/stability/passivity.hpp).
inline constexpr double kContactSpeed_m_per_s = 0.15;
// The same for rotation: the contact speed at the end of a handle of 0.16 m, held in its middle.
inline constexpr double kTurnSpeed_rad_per_s = kContactSpeed_m_per_s / 0.08;

struct PassivitySettings {
    bool control = true;                // false: observe only
    double max_damping_Ns_per_m = 5.0;  // a_max: a tenth of what stops the Omni's own 45 g in a tick
    double reserve_J = 0.0005;          // the energy of hand and stylus at 0.1 m/s
    // The promise holds up to these speeds, over this many lost ticks in a row.
    double contact_speed_m_per_s = kContactSpeed_m_per_s;
    double turn_speed_rad_per_s = kTurnSpeed_rad_per_s;
    std::uint32_t lost_ticks = 5;
    // A body's work on the hand counts as honest up to this speed: that of a ball that has fallen from 0.2 m.
    double surface_speed_m_per_s = 2.0;
};

}  // namespace burin::haptics
