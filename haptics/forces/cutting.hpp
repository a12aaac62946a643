// SPDX-License-Identifier: MIT
// Carving that feels like carving: the tool eats its way in at a rate set by force and hardness.
//
// The surface that the tick knows is some milliseconds old, and the proxy rests on it. Between the proxy p and the HIP h lies
// material that the hand presses into. The cutting point c is where the tool has eaten to, between the two:
//     dc/dt = F / (H A)      F = k |h - c|,  H the hardness, A the engaged area,   along h - p
// so that the tool is borne by the uncut material ahead of it: the hand feels k (c - h), at 1 kHz, however seldom the carved
// surface is published. The carving side sweeps the tool along c, not along h. When the surface with the cut arrives, the
// proxy moves down to where c is, and c stays where it was.
// Engaged area: of a ball of radius R pressed d deep into material, the cap 2 pi R d, at most half the ball, projected on
// the direction of the cut: A = pi (2 R d - d^2), d <= R. At the device lengths are divided by the gain; areas too (g^2).
// Frame: object, metres. Pure; no clock, heap, lock or throw.
#pragma once

#include "base/space.hpp"
#include "haptics/forces/touch_material.hpp"

namespace burin {

struct CuttingState {
    Vec3 point_object_m{0.0};  // c: where the tool has eaten to
    bool engaged = false;      // false: c is the proxy
};

struct CuttingInput {
    Vec3 hip_object_m{0.0};
    Vec3 proxy_object_m{0.0};  // on the surface as it is known; the HIP itself in free space
    Vec3 velocity_device_m_per_s{0.0};
    Quat object_from_device_orientation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;              // object metres a device metre
    double tool_radius_m = 0.0;      // object frame
    bool cutting = false;            // the button is pressed and the tool cuts
    double stiffness_N_per_m = 0.0;  // at the device, after the limiter
    double dt_s = 0.0;
};

struct CuttingStep {
    CuttingState next;
    Vec3 bearing_object_m{0.0};      // what the spring pulls the hand to: c while cutting, else the proxy
    Vec3 drag_device_N{0.0};         // viscous, against the motion
    double engaged_area_m2 = 0.0;    // at the device
    double cut_speed_m_per_s = 0.0;  // of c, at the device
};

[[nodiscard]] CuttingStep cut(const CuttingState& state, const CuttingInput& input,
                              const TouchMaterial& material) noexcept;

}  // namespace burin
