// SPDX-License-Identifier: MIT
// The limits that the gate keeps (haptics/stability/safety_gate.hpp). Plain data.
#pragma once

namespace burin::haptics {

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

}  // namespace burin::haptics
