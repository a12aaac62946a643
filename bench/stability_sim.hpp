// SPDX-License-Identifier: MIT
// One force-feedback device in one hand against one wall: the device and the hand in continuous time, the controller sampled.
//
// One axis, up is positive, the wall fills what is below 0. The device is a mass with damping and Coulomb friction that holds it
// still until more pulls; the hand adds its mass and pulls by a spring and a damper towards where it wants to be. Positions are
// read in encoder steps, forces clamped, held for a period, and act a delay after they are told. Between events the motion is
// solved with exact exponentials in steps of at most 50 us, the hand's spring taken at the middle of each; a stop within a step is
// found exactly. The controller is Burin's own: velocity and filter (haptics/signals), coupling, limiter, passivity
// (haptics/stability), force (haptics/forces).
// The same case gives the same bits.
#pragma once

#include <vector>

#include "devices/simulated_hand.hpp"
#include "haptics/signals/smoothing.hpp"
#include "haptics/stability/passivity.hpp"
#include "haptics/stability/stiffness_limit.hpp"
#include "haptics/stability/virtual_coupling.hpp"

namespace burin::bench {

// The Omni as devices/simulated_omni.hpp has it, without its delay.
[[nodiscard]] DeviceDescription omni_without_delay();

// What the hand does.
enum class HandTask {
    none,      // no hand: the device flies free inside a wall with two sides, at the tap's speed
    tap,       // comes down on the wall at the tap's speed and rests there, pressing
    push_out,  // taps, and is drawn back out at that speed
};

struct StabilityCase {
    DeviceDescription device = omni_without_delay();
    HandTask task = HandTask::tap;
    HandGrip grip{0.1, 100.0, 3.0};
    double press_N = 1.0;  // how hard the hand rests on the wall
    double tap_speed_m_per_s = 0.1;
    double wall_damping_Ns_per_m = 0.0;
    SignalSettings signals;
    CouplingSettings coupling;
    PassivitySettings passivity;
    bool control = false;  // the passivity controller
    bool limit = false;    // the stiffness limiter
    double duration_s = 1.5;
};

struct Trace {
    double time_s = 0.0, position_m = 0.0, force_N = 0.0;
};

struct StabilityRun {
    CoupledWall rendered;         // through coupling and limiter
    double swing_m = 0.0;         // highest minus lowest in the last fifth
    double early_m = 0.0;         // largest distance from 0 in the first fifth, and
    double late_m = 0.0;          // in the last
    double force_change_N = 0.0;  // mean of |F(n) - F(n-1)| in contact
    double late_change_N = 0.0;   // in the last fifth
    double net_energy_J =
        0.0;  // the most that the wall had given out in a contact beyond what the device took: 0 if passive
    double deepest_m = 0.0;         // into the wall
    std::uint32_t acted_ticks = 0;  // of the passivity controller
    std::uint32_t contact_ticks = 0;
};

// trace: where each tick is written; may be null.
[[nodiscard]] StabilityRun run_wall(const StabilityCase& what, double stiffness_N_per_m,
                                    std::vector<Trace>* trace = nullptr);

// A held device has settled when it stays within two encoder steps (or 2 um where they are finer) and its force changes by no
// more than 0.01 N a tick on the mean; a free one when it swings no wider at the end than at the beginning.
[[nodiscard]] bool stable(const StabilityCase& what, const StabilityRun& run);

// The stiffness up to which all that was tried is stable: in steps of 1.5 from `lowest` on, then halved down to 0.1 %; 0 when the
// lowest is not, `highest` when all are.
[[nodiscard]] double largest_stable_stiffness(const StabilityCase& what, double lowest_N_per_m = 10.0,
                                              double highest_N_per_m = 2e5);

}  // namespace burin::bench
