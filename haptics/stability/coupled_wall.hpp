// SPDX-License-Identifier: MIT
// A wall as a spring and a damper, the virtual coupling through which it is felt, and why a device renders less than is
// asked: what ticks keep of a wall. How it is found is in haptics/stability/rendered_wall.hpp.
// Units as felt at the device. Plain data.
#pragma once

#include <cstdint>

namespace burin::haptics {

struct VirtualCoupling {
    double stiffness_N_per_m = 0.0;  // Kc; 0: no coupling, the hand is the tool
    double damping_Ns_per_m = 0.0;   // Bc
};

struct CoupledWall {
    double stiffness_N_per_m = 0.0;
    double damping_Ns_per_m = 0.0;
};

// The tightest bound; shown as the reason for a limit.
enum class StiffnessBound : std::uint8_t {
    none,  // the desired stiffness and damping are within all bounds
    // Damping and friction of the device against sampling and delay, at the contact speed it is meant for.
    sampling,
    quantisation,  // Coulomb friction against the encoder's step: K <= 2 f_c / D
    device,        // the limit that the device's maker gives
    // The stiffness is kept; the desired virtual damping is more than the device can compensate.
    damping,
    rotation,  // one of these, of the torque that several points give together
};

// A sentence for people; static storage.
[[nodiscard]] const char* text(StiffnessBound bound) noexcept;
// The same in a few words: "the device", "its sampling and delay"; empty for none.
[[nodiscard]] const char* short_text(StiffnessBound bound) noexcept;

}  // namespace burin::haptics
