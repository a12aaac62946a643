// SPDX-License-Identifier: MIT
// Simulates one force-feedback device in one hand against one wall:
// the device and the hand in continuous time, the controller sampled.
//
// One axis, up is positive, the wall fills what is below 0. The device is a mass with damping and Coulomb friction that
// holds it still until a larger force acts; the hand adds its mass and pulls by a spring and a damper towards its goal.
// Positions are read in encoder steps; forces are clamped, held for a period, and act a delay after they are commanded.
// Between events the motion is solved with exact exponentials in steps of at most 50 us, the hand's spring taken at the
// middle of each; a stop within a step is found exactly. The controller is Burin's own: velocity and filter
// (haptics/signals), coupling, limiter, passivity (haptics/stability), force (haptics/forces).
// Deterministic: the same case gives the same bits.
#pragma once

#include <vector>

#include "devices/hand/simulated_hand.hpp"
#include "haptics/signals/filters.hpp"
#include "haptics/stability/passivity.hpp"
#include "haptics/stability/rendered_wall.hpp"

namespace burin::bench {

// Returns the Omni of devices/haptic/simulated_omni.hpp, without its delay.
[[nodiscard]] devices::DeviceDescription omni_without_delay();

// The hand's action.
enum class HandTask {
    none,      // no hand: the device moves freely inside a wall with two sides, at the tap's speed
    tap,       // comes down on the wall at the tap's speed and rests there, pressing
    push_out,  // taps, and is drawn back out at that speed
};

struct StabilityCase {
    devices::DeviceDescription device = omni_without_delay();
    HandTask task = HandTask::tap;
    devices::HandGrip grip{0.1, 100.0, 3.0};
    double press_N = 1.0;  // the force with which the hand rests on the wall
    double tap_speed_m_per_s = 0.1;
    double wall_damping_Ns_per_m = 0.0;
    haptics::SignalSettings signals;
    haptics::VirtualCoupling coupling;
    haptics::PassivitySettings passivity;
    bool control = false;  // the passivity controller
    bool limit = false;    // the stiffness limiter
    double duration_s = 1.5;
};

struct Trace {
    double time_s = 0.0, position_m = 0.0, force_N = 0.0;
};

struct StabilityRun {
    haptics::CoupledWall rendered;  // the wall after coupling and limiter
    double swing_m = 0.0;           // highest minus lowest position in the last fifth
    double early_m = 0.0;           // largest distance from 0 in the first fifth
    double late_m = 0.0;            // largest distance from 0 in the last fifth
    double force_change_N = 0.0;    // mean of |F(n) - F(n-1)| in contact
    double late_change_N = 0.0;     // the same in the last fifth
    // Largest energy that the wall had given out in a contact beyond what the device dissipated: 0 if passive.
    double net_energy_J = 0.0;
    double deepest_m = 0.0;         // largest depth in the wall
    std::uint32_t acted_ticks = 0;  // ticks in which the passivity controller acted
    std::uint32_t contact_ticks = 0;
};

// trace receives each tick; may be null.
[[nodiscard]] StabilityRun run_wall(const StabilityCase& what, double stiffness_N_per_m,
                                    std::vector<Trace>* trace = nullptr);

// Returns whether the run is stable. A held device is stable if it stays within two
// encoder steps (or 2 um where they are finer) and its force changes by no more than 0.01
// N a tick on average; a free one if it swings no wider at the end than at the beginning.
[[nodiscard]] bool stable(const StabilityCase& what, const StabilityRun& run);

// What a scan over the stiffness found. Instability comes in windows: a wall may shake at one stiffness and settle at
// a greater one, so the whole range is tested, in steps of one ratio, and nothing is skipped.
struct StiffnessScan {
    double stable_up_to_N_per_m = 0.0;   // every tested stiffness up to here is stable; 0: the lowest is not
    double first_failure_N_per_m = 0.0;  // the lowest that is not stable; 0: all are
    double failing_share = 0.0;          // of the tested ones from the first failure to the end of the scan
};

// Tests lowest, lowest * ratio, ... , highest; the edge of the first failure is then found to 0.1 %.
[[nodiscard]] StiffnessScan scan_stiffness(const StabilityCase& what, double lowest_N_per_m, double highest_N_per_m,
                                           double ratio = 1.01);

}  // namespace burin::bench
