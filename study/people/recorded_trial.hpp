// SPDX-License-Identifier: MIT
// What a study folder keeps of a trial: its metrics, and the table of all trials that burin study analyse reads. Pure;
// any thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "study/felt/stage_session.hpp"

namespace burin::study {

// Of a trial as it ended and of what the haptic model makes of its motion; null for what is no valid trial. Deviation
// (W17) is given twice: by distance to the wall, which is the headline, and to the proxy of the model. The two agree
// but where the hand leaves the tube and comes back elsewhere: the proxy hangs where it cannot follow. A trial in which
// they differ by more than kDeviationsAgree_mm in a point's mean is flagged. Contact and force are the model's; a
// flagged trial has none.
[[nodiscard]] Json trial_record(const StudyWorld& world, const StageState& end, std::span<const StageEvent> events,
                                const ModelTouch& model);
inline constexpr double kDeviationsAgree_mm = 1.0;
inline constexpr const char* kTorqueFigure = "torque_largest_Nm";

// Of any other stage in which something was felt: contact and force as they were given to the hand.
[[nodiscard]] Json forces_record(const FeltForces& forces);

// What moved the wand: a simulated learner or a script, which are no persons; mouse, keys or a log, with a simulated
// device in a live session; or a device.
enum class Hand { learner, script, simulated_device, device };
[[nodiscard]] const char* name_of(Hand hand);  // "learner", "script", "simulated device", "device"

struct TrialRow {
    std::string participant, group, stratum, stage;
    std::size_t day = 1, number = 1;  // which outcome trial of the participant
    Json record;                      // by trial_record
    Hand hand = Hand::device;
};
// CSV, with lines that say how the numbers came about and whose hands were simulated.
[[nodiscard]] std::string trials_csv(std::span<const TrialRow> rows);

// A whole sentence that says how many of the rows' participants are no persons, or held a simulated device; empty where
// all held a device.
[[nodiscard]] std::string simulated_fact(std::span<const TrialRow> rows);

}  // namespace burin::study
