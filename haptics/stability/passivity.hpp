// SPDX-License-Identifier: MIT
// Time-domain passivity observer and controller: counts the energy that the sampled wall takes and gives, and takes back, by a
// bounded damping, what it gives out too much (Hannaford and Ryu 2002; a force held between samples counts exactly, Ryu,
// Preusche, Hannaford and Hirzinger 2005, who also compare with the energy that is meant to be there instead of with 0).
//
//   E(n) = E(n-1) - f . (x(n) - x(n-1))        what has gone into the wall since the contact began; f is what acted in
//                                              between: told a transport delay before
//   R(n) = R(n-1) + [E(n) - E(n-1)] - [U(n) - U(n-1)] + c |dx| + b dx^2 / T,   R <= reserve
//   R < 0: f += -a v along f, a = min(-R / (v^2 T (1 + delay in ticks)), a_max), v = dx / T
//
// U is what the wall's springs hold. A passive wall has E >= U, since what it holds has been put in; how far it is below is what
// it will give out too much, known while the hand is still in it, and not only when it has left. c and b are the device's
// friction and damping: what they take away the wall may give out, so the controller is quiet wherever the stiffness limiter's
// promise holds (stiffness_limit.hpp). The reserve is bounded, or a long quiet contact would pay for a later shaking.
//
// It acts along the wanted force only, never turns that round (no pull), never drives in the direction of motion (no energy), and
// is quiet below two encoder steps of motion a tick: there v is no step, one or two a period, and damping by it would chatter.
// All is reset in free space once no force is left. While the gate fades a force in it waits.
// Frame: device. Pure; no clock, heap, lock or throw.
#pragma once

#include <array>
#include <cstdint>

#include "devices/haptic_device.hpp"

namespace burin {

struct PassivitySettings {
    bool control = true;                // false: observe only
    double max_damping_Ns_per_m = 5.0;  // a_max: a tenth of what stops the Omni's own 45 g in a tick
    double reserve_J = 0.0005;          // what hand and stylus bring along at 0.1 m/s
};

struct PassivityState {
    static constexpr std::uint32_t kLongestDelay = 8;       // ticks of transport; longer ones count as this
    std::array<Vec3, kLongestDelay + 1> forces_device_N{};  // told, a ring: it takes a delay until they act
    std::uint32_t newest = 0;
    Vec3 position_device_m{0.0};  // x(n-1)
    double asked_N = 0.0;         // what the gate was asked for, as far as the device can give it
    double energy_J = 0.0;        // E
    double stored_J = 0.0;        // U
    double reserve_J = 0.0;       // R
    bool known = false;           // false: no tick before, or not known what the device was told: nothing to count
    bool fading = false;          // the gate gave less than asked for
};

struct PassivityInput {
    Vec3 position_device_m{0.0};
    Vec3 wanted_force_device_N{0.0};
    double stored_J = 0.0;     // what the wall's springs hold at this position
    double max_force_N = 0.0;  // what gate and device give at most; 0: no limit
    bool in_contact = false;
    bool jumped = false;  // the contact is not continuous with the one before
};

struct PassivityStep {
    PassivityState next;            // told() completes it when the gate has spoken
    Vec3 force_device_N{0.0};       // the wanted force with the controller's damping
    double energy_J = 0.0;          // E(n) before the controller acts
    double damping_Ns_per_m = 0.0;  // a; 0: the controller is quiet
};

[[nodiscard]] PassivityStep keep_passive(const PassivityState& state, const PassivityInput& input,
                                         const PassivitySettings& settings, const DeviceDescription& device,
                                         double dt_s) noexcept;

// What the device was told at last, after the gate; once a tick, after keep_passive.
[[nodiscard]] PassivityState told(PassivityState state, const Vec3& force_device_N) noexcept;

}  // namespace burin
