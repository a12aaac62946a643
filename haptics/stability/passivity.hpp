// SPDX-License-Identifier: MIT
// Time-domain passivity observer and controller: counts the energy that the sampled wall takes and gives, and removes,
// by bounded damping, what it gives in excess (Hannaford and Ryu 2002; the energy of a force held between samples is
// exact, Ryu, Preusche, Hannaford and Hirzinger 2005, who also compare with the energy that is meant to be there
// instead of with 0).
//
//   E(n) = E(n-1) - f . (x(n) - x(n-1))        energy put into the wall since the contact began; f is what acted in
//                                              between, commanded a transport delay before; torque and rotation too
//   R(n) = R(n-1) + [E(n) - E(n-1)] - [U(n) - U(n-1)] + c |dx| + b dx^2 / T + f . s,   R <= reserve
//   R < 0: f += -a v along f, a = min(-R / (v^2 T (1 + delay in ticks)), a_max)
//
// U is the energy stored in the wall's springs. A passive wall has E >= U, since what it stores has been put in. The
// amount by which E is below U is what the wall will give in excess, known while the hand is still in it and not only
// when it has left. c and b are the device's friction and damping: the wall may give out what they dissipate, so the
// damping is inactive wherever the stiffness limiter's promise holds (rendered_wall.hpp). The reserve is bounded,
// or a long quiet contact would pay for a later oscillation.
//
// s is the way of the surface touched, as its publisher has announced it (haptics/contact/moving_bodies.hpp): a body
// that moves may honestly do work on the hand, and f . s is that work. The rule, and its bounds: only the force that
// has acted counts, only along the announced velocity, which counts up to settings.surface_speed_m_per_s, and never for
// what nothing explains; the certain account takes what a body gives and never what it takes back; and as ever neither
// keeps more than what the springs store and the reserve, so that no body's work pays for an oscillation after it.
//
// v is taken over the shortest window of at most 16 ticks in which the tool has moved by two encoder steps: over one
// tick, v is zero, one or two steps a period where the motion is slow, and damping by it would chatter. The damping
// acts along the desired force only, never reverses it (no pull), never drives in the direction of motion (no energy).
// While the gate fades a force in, it waits.
//
// Last the whole wrench is scaled to what the energy account affords (energy_account.hpp), which is exact, and keeps
// the promise over lost ticks and while forces fade in: R is what is to be expected, the account what is certain.
// Where nothing is known of the device's friction and damping nothing is promised, and nothing is scaled.
// Frame: device. Pure; no clock, heap, lock or throw.
#pragma once

#include <cmath>

#include "haptics/signals/filters.hpp"
#include "haptics/stability/energy_account.hpp"
#include "haptics/stability/passivity_record.hpp"
#include "haptics/stability/passivity_settings.hpp"
#include "haptics/stability/rendered_wall.hpp"

namespace burin::haptics {

// What the observer has counted since contact began, and of the last tick.
struct PassivityObserver {
    EnergyAccount account;
    Vec3 position_device_m{0.0};  // x(n-1)
    double asked_N = 0.0;         // magnitude of the desired force, as far as the device can give it
    std::uint32_t delay_ticks = 0;
    double energy_J = 0.0;   // E
    double stored_J = 0.0;   // U
    double reserve_J = 0.0;  // R
    // False: there was no tick before, or its commanded force is not known, so there is no energy to count.
    bool known = false;
    // Ticks in which what acts may still be less than the springs' force: the gate or the account gave less than that.
    std::uint32_t faded_ticks = 0;
};

struct PassivityInput {
    Nanoseconds time_ns = 0;  // of the sample
    Nanoseconds now_ns = 0;   // when the wrench is commanded
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    // The last positions, this one included; null: the last two are used.
    const VelocityWindow* window = nullptr;
    devices::DeviceWrench wanted;
    double stored_J = 0.0;     // energy stored in the wall's springs at this position
    double max_force_N = 0.0;  // the most that gate and device give; 0: no limit
    bool turns = false;        // the device may be given torque
    bool in_contact = false;
    // The part drives one way: positions, forces and the surface's velocity are along its drive, as their x. Its
    // springs are also pressed by what does no work on the drive, so what they store says nothing of what has gone in:
    // the account alone judges, and nothing is damped.
    bool one_way = false;
    bool jumped = false;                        // the contact is not continuous with that of the last tick
    Vec3 surface_velocity_device_m_per_s{0.0};  // of the surface touched
};

struct PassivityStep {
    PassivityObserver next;        // set_commanded_wrench() completes it after the gate
    devices::DeviceWrench wrench;  // the desired one with the controller's damping, scaled to what is affordable
    PassivityRecord record;
};

// Updates the energy account with this tick's motion, damps the desired force where more would come out than went in,
// and scales the wrench to what the account affords.
[[nodiscard]] PassivityStep keep_passive(const PassivityObserver& state, const PassivityInput& input,
                                         const PassivitySettings& settings, const devices::DeviceDescription& device,
                                         double dt_s) noexcept;

// How long after a tick the device may hold what that tick commands, by the account's promise: over the ticks that may
// be lost. 0: nothing is promised, since the controller only observes, or friction and damping are not known of all
// that the device drives.
[[nodiscard]] double promised_gap_s(const PassivitySettings& settings, const devices::DeviceDescription& device,
                                    double dt_s) noexcept;

// Stores the wrench commanded to the device after the gate. Call it once a tick, after keep_passive().
void set_commanded_wrench(PassivityObserver& state, const devices::DeviceWrench& wrench, Nanoseconds now_ns) noexcept;

}  // namespace burin::haptics
