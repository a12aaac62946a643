// SPDX-License-Identifier: MIT
// The last step before the device, always on: whatever the contact model asks for, the commanded wrench is finite,
// within the force and torque limits, and changes no faster than the slew limits; and it is zero when something is
// wrong. Force and torque are limited separately, by scaling without a change of direction, except that passive axes
// get no torque. Of a part that drives one way the limits are those of the force along its drive, which may turn
// meanwhile.
//
// A pure function with its state in a struct: no clock, heap, lock or throw; wait-free, a few dozen operations.
// Order: faults (zero at once: safe comes before smooth), ramps, limits, slew. A limit that is lowered while a force or
// a torque is on wins over the slew limit. After a fault has gone the gate waits recovery_s, then fades in again over
// ramp_s; a contact that has jumped fades in over contact_ramp_s. Every zero force has a cause: it is named in
// GateOutput::cause, kept in the tick record, and has a text for people.
// Lost ticks: over gaps up to promised_gap_s the energy account alone decides, since the force that it affords stays
// safe for so long. Where it promises nothing, one lost tick is passed over; from the second on the force is scaled
// down, the more the longer the gap, to zero at max_loop_gap_s, and fades in again over contact_ramp_s. Beyond the
// longer of the two gaps the force is zero, with a cause, and comes back over the ramp as far as the account affords. A
// gap in which no force was on the motors moved nothing, so it is no fault, but a contact that has begun meanwhile
// fades in.
// A force that fades in is a spring that grows stiffer while it is pressed, which takes energy out of nothing: so the
// desired wrench never exceeds what the energy account affords (haptics/stability/energy_account.hpp), ramp or not.
#pragma once

#include <cmath>
#include <cstdint>

#include "devices/haptic/haptic_device.hpp"
#include "haptics/stability/gate_limits.hpp"
#include "haptics/stability/gate_output.hpp"

namespace burin::haptics {

struct GateInput {
    devices::DeviceWrench wanted;
    Vec3 velocity_device_m_per_s{0.0};
    double device_max_force_N = 0.0;
    Vec3 device_axis_max_force_N{0.0};  // 0: that axis has no limit of its own
    Vec3 device_max_torque_Nm{0.0};     // 0: that axis is passive
    Vec3 drives_device{0.0};            // unit: along which alone a part drives now; zero: it drives every direction
    double most_torque_Nm = HUGE_VAL;   // about any axis: what the energy account affords
    double sample_age_s = 0.0;          // now minus the sample's time
    double loop_gap_s = 0.0;            // now minus the last tick's time; 0 for the first
    double promised_gap_s = 0.0;        // over which the energy account keeps its promise; 0: it makes none
    devices::DeviceFault device_fault = devices::DeviceFault::none;
    bool sample_finite = true;
    bool within_reach = true;  // the sample's position, of the device's arm
    bool parameters_sensible = true;
    bool scale_felt = true;  // is_felt_at() of the mapping's scale (haptics/tick.hpp)
    bool in_contact = false;
    bool contact_jumped = false;  // the contact is not continuous with that of the last tick: fade in
    bool surface_stale = false;
    bool outside_known = false;
    bool let_go = false;  // a contact has been given up (haptics/contact/contact_watch.hpp)
};

struct GateState {
    // The share of the desired wrench that the ramps let through.
    [[nodiscard]] double faded() const { return ramp * contact_ramp; }

    devices::DeviceWrench given;  // commanded in the last tick
    double ramp = 0.0;            // 0 to 1, at the start and after a fault
    double contact_ramp = 1.0;    // 0 to 1, after a contact that has jumped, and after lost ticks
    double well_s = 0.0;          // time since the last fault
    bool faulted = false;         // a fault has happened and recovery_s is not yet over
};

struct GateStep {
    GateState next;
    GateOutput output;
};

// Turns the desired wrench into the commanded one.
[[nodiscard]] GateStep pass_gate(const GateState& state, const GateInput& input, const GateLimits& limits,
                                 double dt_s) noexcept;

}  // namespace burin::haptics
