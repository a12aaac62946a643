// SPDX-License-Identifier: MIT
// The arm that a mouse leads: a simulated one that nobody feels, and so without what a real arm must have. A mouse has
// neither friction nor a force to bear; with an Omni's 0.26 N and a hand of 200 N/m the tool stood up to 1.3 mm beside
// the cursor, and slipped sideways under a force across. So the arm has damping in place of friction, and with it walls
// of 50 kN/m are passive (100 Ns/m over 1.5 ms are 67, haptics/stability/rendered_wall.hpp): a tool that needs 2 N to
// cut is 0.04 mm behind where it is led. The workspace is a cube, since what is turned before the viewer is as deep as
// it is wide.
#pragma once

#include "devices/hand/simulated_hand.hpp"
#include "devices/haptic/simulated_omni.hpp"

namespace burin::devices {

inline constexpr const char* kMouseArm = "mouse";
// A stroke begins where the button went down, and not where the hand is still under way from.
inline constexpr double kMousePressesWithin_m = 2e-4;

[[nodiscard]] inline OmniModel mouse_arm() {
    OmniModel model;
    model.name = "arm of a mouse";
    model.workspace_m = Vec3(0.12);
    model.resolution_m = 1e-6;
    model.friction_N = 0.0;
    model.damping_Ns_per_m = 100.0;
    model.max_stiffness_N_per_m = 5e4;
    return model;
}

// Holds the arm where the mouse points: all of its 3.3 N push it away by 7 um, and its damping at 0.6 m/s holds it back
// by 0.12 mm. The damping ratio of the 145 g of hand and arm is 1.
[[nodiscard]] inline HandGrip mouse_grip() {
    HandGrip grip;
    grip.stiffness_N_per_m = 5e5;
    grip.damping_Ns_per_m = 440.0;
    return grip;
}

}  // namespace burin::devices
