// SPDX-License-Identifier: MIT
// Time-domain passivity observer and controller: counts the energy that the sampled wall takes and gives, and removes,
// by bounded damping, what it gives in excess (Hannaford and Ryu 2002; the energy of a force held between samples is
// exact, Ryu, Preusche, Hannaford and Hirzinger 2005, who also compare with the energy that is meant to be there
// instead of with 0).
//
//   E(n) = E(n-1) - f . (x(n) - x(n-1))        energy put into the wall since the contact began; f is the
//                                              force that acted in between: commanded a transport delay before
//   R(n) = R(n-1) + [E(n) - E(n-1)] - [U(n) - U(n-1)] + c |dx| + b dx^2 / T,   R <= reserve
//   R < 0: f += -a v along f, a = min(-R / (v^2 T (1 + delay in ticks)), a_max), v = dx / T
//
// U is the energy stored in the wall's springs. A passive wall has E >= U, since what it stores has been put in. The
// amount by which E is below U is what the wall will give in excess, known while the hand is still in it and not only
// when it has left. c and b are the device's friction and damping: the wall may give out what they dissipate, so the
// controller is inactive wherever the stiffness limiter's promise holds (stiffness_limit.hpp). The reserve is bounded,
// or a long quiet contact would pay for a later oscillation.
//
// The controller acts along the desired force only, never reverses it (no pull), never drives in the direction of
// motion (no energy), and is inactive below two encoder steps of motion a tick: there v is zero, one or two steps a
// period, and damping by it would chatter. All is reset in free space once no force is left. While the gate fades a
// force in, the controller waits.
// Frame: device. Pure; no clock, heap, lock or throw.
#pragma once

#include <array>
#include <cstdint>

#include "devices/haptic/haptic_device.hpp"

namespace burin::haptics {

struct PassivitySettings {
    bool control = true;                // false: observe only
    double max_damping_Ns_per_m = 5.0;  // a_max: a tenth of what stops the Omni's own 45 g in a tick
    double reserve_J = 0.0005;          // the energy of hand and stylus at 0.1 m/s
};

struct PassivityState {
    static constexpr std::uint32_t kLongestDelay = 8;  // ticks of transport; longer ones count as this
    // Commanded forces, a ring buffer: they act after the transport delay.
    std::array<Vec3, kLongestDelay + 1> forces_device_N{};
    std::uint32_t newest = 0;
    Vec3 position_device_m{0.0};  // x(n-1)
    double asked_N = 0.0;         // magnitude asked of the gate, as far as the device can give it
    double energy_J = 0.0;        // E
    double stored_J = 0.0;        // U
    double reserve_J = 0.0;       // R
    // False: there was no tick before, or its commanded force is not known, so there is no energy to count.
    bool known = false;
    bool fading = false;  // the gate gave less than was asked of it
};

struct PassivityInput {
    Vec3 position_device_m{0.0};
    Vec3 wanted_force_device_N{0.0};
    double stored_J = 0.0;     // energy stored in the wall's springs at this position
    double max_force_N = 0.0;  // the most that gate and device give; 0: no limit
    bool in_contact = false;
    bool jumped = false;  // the contact is not continuous with that of the last tick
};

// What the controller saw and did in a tick.
struct PassivityRecord {
    double energy_J = 0.0;          // E(n), put into the rendered world since contact began, before the controller acts
    double damping_Ns_per_m = 0.0;  // a; 0: the controller is inactive
};

struct PassivityStep {
    PassivityState next;       // with_commanded_force() completes it after the gate
    Vec3 force_device_N{0.0};  // the desired force with the controller's damping
    PassivityRecord record;
};

// Updates the energy account with this tick's motion and damps the desired force where the account is negative.
[[nodiscard]] PassivityStep keep_passive(const PassivityState& state, const PassivityInput& input,
                                         const PassivitySettings& settings, const devices::DeviceDescription& device,
                                         double dt_s) noexcept;

// Stores the force commanded to the device after the gate. Call it once a tick, after keep_passive().
[[nodiscard]] PassivityState with_commanded_force(PassivityState state, const Vec3& force_device_N) noexcept;

}  // namespace burin::haptics
