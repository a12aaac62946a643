// SPDX-License-Identifier: MIT
// What the rendered world may still give out: a lower bound of the energy that has gone into it and of what the
// device's friction and damping have dissipated since contact began, less what has come out; and the greatest wrench
// that cannot overdraw it.
//
//   A(t) = - integral of (f . v + torque . w) + integral of (c |v| + b v^2 + c_r |w| + b_r w^2) since contact began
//
// The promise is A >= 0 at every moment: whatever the hand does, only the hand puts energy in. It is kept by what is
// commanded, not by what is rendered, so it holds for springs, dampers, filters, forces that fade in, changed materials
// and lost ticks alike. A force F that acts for a time H while the tool moves at most at V takes at most
// H max over v <= V of ((F - c) v - b v^2) out of A. So a tick that commands no more than
//
//   F <= c + 2 sqrt(b A / H)        where that is at most c + 2 b V
//   F <= c + b V + A / (V H)        else
//
// keeps A >= 0 until the next tick's command acts, H being the longest time until then: transport delay, and as many
// periods as may be lost (settings.lost_ticks), or the device's own watchdog where it has a shorter one. Forces of at
// most c need no energy: they move nothing by themselves. (Energy bounding after Kim and Ryu 2010, whose bound is the
// damping alone; energy tanks after Franken, Stramigioli, Misra, Secchi and Macchelli 2011.)
//
// Exactness. The wrench that acts is the one commanded a transport delay before, also over lost ticks: the work of a
// held force is that force times the way, however long it was held. Positions are read in steps of D: where the force
// changes by dF, the work is uncertain by dF D/2, and by more where it changes between two samples, as far as the tool
// can be away from the straight line at the speed V. Both are charged. Friction is credited for the shortest way that
// the read positions admit (a play of half a step), damping for the slowest motion that they admit.
// A surface that moves adds the work that the acting force has done along its announced velocity, where that is above
// zero (haptics/stability/passivity.hpp states the rule): then only the hand and announced bodies put energy in.
// Frame: device. Pure; no clock, heap, lock or throw; bounded loops.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "devices/haptic/haptic_device.hpp"

namespace burin::haptics {

// The limits within which the promise is kept.
struct PromiseLimits {
    double speed_m_per_s = 0.0;         // V
    double turn_speed_rad_per_s = 0.0;  // likewise for rotation
    std::uint32_t lost_ticks = 0;       // in a row, on top of half a period of jitter
    double period_s = 0.001;
};

// A position or an accumulated rotation, and what is known of its way.
struct Path {
    Vec3 at{0.0};      // as read
    Vec3 play{0.0};    // follows at half an encoder step: its way is the shortest possible one
    Vec3 anchor{0.0};  // at the time anchor_ns; for the slowest possible motion since
    Nanoseconds anchor_ns = 0;
};

struct EnergyAccount {
    // The longest transport delay in ticks; longer ones count as this. The ring holds what acts and what is on its way.
    static constexpr std::uint32_t kLongestDelay = 8, kCommands = kLongestDelay + 4;
    struct Command {
        devices::DeviceWrench wrench;
        Nanoseconds time_ns = 0;
    };
    std::array<Command, kCommands> commands{};
    std::uint32_t newest = 0;
    Nanoseconds time_ns = 0;  // of the last sample
    Path moved, turned;
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    double budget_J = 0.0;        // A, at least
    bool counting = false;        // in contact, or its forces are not yet gone
    std::uint32_t overtaken = 0;  // samples in a row that were no newer, and not counted
};

struct AccountInput {
    Vec3 position_device_m{0.0};
    Quat orientation_device{1.0, 0.0, 0.0, 0.0};
    Nanoseconds time_ns = 0;  // of the sample
    bool turns = false;       // the device is given torque, so rotation counts
    bool in_contact = false;
    bool known = true;                          // the motion since the last sample is known
    Vec3 surface_velocity_device_m_per_s{0.0};  // of the surface touched, as far as its motion is announced
};

// What happened since the last sample.
struct AccountStep {
    EnergyAccount next;
    double taken_J = 0.0;             // by the world, from hand and device
    double dissipated_J = 0.0;        // by the device, as far as the read positions tell
    double given_by_surface_J = 0.0;  // by a surface that moves, to hand and springs; negative: taken
    bool counted = false;             // false: the account begins, or there is no contact
};

[[nodiscard]] AccountStep count_energy(const EnergyAccount& account, const AccountInput& input,
                                       const PromiseLimits& promise, const devices::DeviceDescription& device) noexcept;

// Whether friction or damping of the device is known: else nothing can be promised.
[[nodiscard]] bool can_promise(const devices::DeviceDescription& device) noexcept;
// Whether angular friction or damping is known; where neither is, the account does not limit the torque.
[[nodiscard]] bool rotation_is_known(const devices::DeviceDescription& device) noexcept;
// The longest time from tick to tick, lost ticks and jitter included, for which the promise is kept.
[[nodiscard]] double longest_gap_s(const PromiseLimits& promise) noexcept;

// What may be commanded at the time now_ns without overdrawing the account before the next tick's command acts.
struct Affordable {
    double share = 1.0;    // of the wrench, at most 1
    double force_N = 0.0;  // the greatest force, without torque
    // The greatest torque beside the most force that may be commanded, this tick's or what the slew limit holds up of
    // the last one's; infinite where nothing is known of the device's rotation.
    double torque_Nm = HUGE_VAL;
};
[[nodiscard]] Affordable affordable(const EnergyAccount& account, const devices::DeviceWrench& wrench,
                                    const PromiseLimits& promise, const devices::DeviceDescription& device,
                                    Nanoseconds now_ns) noexcept;

// Stores the wrench commanded at now_ns.
void remember(EnergyAccount& account, const devices::DeviceWrench& wrench, Nanoseconds now_ns) noexcept;

}  // namespace burin::haptics
