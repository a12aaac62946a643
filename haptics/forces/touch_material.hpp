// SPDX-License-Identifier: MIT
// How a surface feels. All figures are as felt at the device, whatever the scale of the scene: with a position gain g
// lengths shrink by g on their way to the device. Any of them may change while the loop runs.
#pragma once

#include <cstdint>

namespace burin {

struct TouchMaterial {
    bool enabled = true;  // false: what is made of it cannot be felt
    // F = k dx + b dx/dt along the contact normal. 600 N/m is what the Omni renders crisply.
    double stiffness_N_per_m = 600.0;
    double damping_Ns_per_m = 0.5;
    // Coulomb friction: the proxy sticks until the tangential force exceeds static_friction times the normal one, then slides
    // against dynamic_friction times it. 0 <= dynamic_friction <= static_friction.
    double static_friction = 0.0;
    double dynamic_friction = 0.0;
    // Above 0: nothing sticks; friction grows linearly with the slip speed up to this one (at the device) and is
    // dynamic_friction beyond it.
    double coulomb_velocity_m_per_s = 0.0;
    // Cutting: material goes away at the speed F / (hardness * A), F the force and A the engaged area of the tool. 0: it
    // goes away as fast as the hand moves, without resistance; infinite: not at all.
    double hardness_Ns_per_m3 = 0.0;
    // Viscous drag on the tool while it is engaged in cutting, along its motion, over the engaged area.
    double cutting_drag_Ns_per_m3 = 0.0;
};

inline constexpr std::uint32_t kMostMaterials = 8;  // of one session; a surface names its own by index

}  // namespace burin
