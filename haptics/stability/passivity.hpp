// SPDX-License-Identifier: MIT
// Time-domain passivity observer and controller (Hannaford and Ryu 2002; the energy of a force held between samples is exact,
// Ryu, Preusche, Hannaford and Hirzinger 2005): adds the damping that takes back what the sampled wall gave out too much.
//
//   E(n) = E(n-1) - f(n-1) . (x(n) - x(n-1))     what has gone into the rendered world, per contact; f held over a period
//   E < 0: f += -a v with a = min(-E / (T v^2), a_max), v the difference of positions
// Quiet below two encoder counts of motion a tick, where v is noise and damping by it would chatter; reset in free space.
// Frame: device. Pure; no clock, heap, lock or throw.
#pragma once

#include <cstdint>

#include "base/space.hpp"

namespace burin {

struct PassivitySettings {
    bool control = true;                // false: observe only
    double max_damping_Ns_per_m = 5.0;  // a_max
    double resolution_m = 0.000055;     // the encoder's step
};

struct PassivityState {
    Vec3 position_device_m{0.0};  // x(n-1)
    Vec3 force_device_N{0.0};     // f(n-1): what the device was told
    double energy_J = 0.0;        // E
    bool known = false;           // false: no tick before
};

struct PassivityStep {
    PassivityState next;            // force_device_N is to be set by told() when the gate has spoken
    Vec3 force_device_N{0.0};       // the wanted force with the controller's damping
    double energy_J = 0.0;          // E(n) before the controller acts
    double damping_Ns_per_m = 0.0;  // a; 0: the controller is quiet
};

[[nodiscard]] PassivityStep keep_passive(const PassivityState& state, const Vec3& position_device_m,
                                         const Vec3& wanted_force_device_N, bool in_contact,
                                         const PassivitySettings& settings, double dt_s) noexcept;

// What the device was told at last, after the gate.
[[nodiscard]] PassivityState told(PassivityState state, const Vec3& force_device_N) noexcept;

}  // namespace burin
