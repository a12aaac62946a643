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

namespace burin::haptics {

// Why the gate gives zero. In order of precedence.
enum class GateCause : std::uint8_t {
    none,
    device_fault,    // the device itself reports one; see DeviceSample::fault
    not_finite,      // a sample, a desired force or a device limit is NaN, infinite or negative
    bad_parameters,  // settings that make no sense, such as a negative stiffness
    bad_scale,       // a scene so small or large that numbers do not resolve it at the device's motions
    stale_sample,    // the device has stopped sending
    future_sample,   // its time stamps lie ahead of the loop's clock
    out_of_reach,    // it reports a position that its arm cannot reach
    overspeed,       // the tool moves faster than any hand should
    stale_surface,   // in contact with a surface that the carving side no longer keeps up to date
    outside_known,   // in contact where the surface is not known
    caught,          // the tool was held by a contact that is not there, and has been let go
    lost_loop,       // the loop itself stood still: what it knows of the hand is out of date
};

// A sentence for people; static storage.
[[nodiscard]] const char* text(GateCause cause) noexcept;

struct GateLimits {
    double max_force_N = 3.3;                // an Omni's; a session takes its device's, which bounds it in any case
    double max_slew_N_per_s = 1000.0;        // 1 N a tick at 1 kHz: about what a 600 N/m wall needs at 1.7 m/s
    double max_torque_slew_Nm_per_s = 80.0;  // the same at the end of a handle of 0.16 m
    double contact_ramp_s = 0.1;             // after a contact that has jumped: an edit, a moved workspace
    double ramp_s = 0.2;                     // from zero to full at the start and after a fault
    double recovery_s = 0.05;                // time without fault before the ramp begins again
    double max_speed_m_per_s = 3.0;          // of the tool, at the device
    double max_sample_age_s = 0.02;          // 20 ticks without a new sample
    double max_loop_gap_s = 0.005;           // since the last tick; four and a half periods where that is longer
    double max_ahead_s = 0.005;              // of a sample's time stamp, before the clock
};

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

struct GateOutput {
    devices::DeviceWrench given;  // the commanded wrench
    GateCause cause = GateCause::none;
    bool saturated = false;
    bool slew_limited = false;
    bool ramping = false;
};

struct GateStep {
    GateState next;
    GateOutput output;
};

// Turns the desired wrench into the commanded one.
[[nodiscard]] GateStep pass_gate(const GateState& state, const GateInput& input, const GateLimits& limits,
                                 double dt_s) noexcept;

}  // namespace burin::haptics
