// SPDX-License-Identifier: MIT
// How the surface of a material and the weight of a held tool feel to a tick, as plain data; forces are made of them in
// haptics/forces/touch_force.hpp.
#pragma once

#include <cstdint>

#include "base/space.hpp"

namespace burin::haptics {

// All figures are as felt at the device, whatever the scale of the scene: with a position gain g lengths at the device
// are shorter by g. Any of them may change while the loop runs.
struct TouchMaterial {
    bool enabled = true;  // false: surfaces of this material cannot be felt
    // F = k dx + b dx/dt along the contact normal. 600 N/m is what the Omni renders crisply.
    double stiffness_N_per_m = 600.0;
    double damping_Ns_per_m = 0.5;
    // Coulomb friction: the proxy sticks until the tangential force exceeds static_friction times the normal force,
    // then slides against dynamic_friction times the normal force. 0 <= dynamic_friction <= static_friction.
    double static_friction = 0.0;
    double dynamic_friction = 0.0;
    // Above 0: nothing sticks; friction grows linearly with the slip speed up to this speed (at the device) and is
    // dynamic_friction beyond it.
    double coulomb_velocity_m_per_s = 0.0;
    // Cutting: the engaged area of the tool is resisted by the pressure p0 + H v, v its speed into the material
    // (haptics/forces/cutting.hpp). H: 0 with p0 = 0, it is removed as fast as the hand moves, without resistance;
    // infinite: never.
    double hardness_Ns_per_m3 = 0.0;
    double cutting_yield_Pa = 0.0;  // p0: below it nothing is removed
    // Grain: both swell and fall by this share, at most 1, with this spacing along a unit axis of the object.
    double grain_share = 0.0, grain_spacing_m = 0.0;
    Vec3 grain_axis_object{1.0, 0.0, 0.0};
    // Viscous drag against the motion of a tool that is cutting, per engaged area.
    double cutting_drag_Ns_per_m3 = 0.0;
};

inline constexpr std::uint32_t kMostMaterials = 16;  // in one session; a surface refers to its material by index

// A held tool: its weight is felt, that of the device's own arm is not.
struct WeightSettings {
    // Weight of the device's arm at the hand that the motors compensate; 0: the device compensates for it itself.
    double compensated_mass_kg = 0.0;
    double tool_mass_kg = 0.0;               // of the virtual tool; its weight pulls down
    Vec3 tool_centre_of_mass_device_m{0.0};  // in the tool's axes, from the device's position
    Vec3 down_device{0.0, -1.0, 0.0};        // unit; direction of gravity in the device frame
};

}  // namespace burin::haptics
