// SPDX-License-Identifier: MIT
// What a study folder keeps of a trial: its metrics, and the table of all trials that burin study analyse reads. Pure;
// any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "study/folder/held_device.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {

struct ModelTouch;  // study/felt/repeated_stage.hpp
struct FeltForces;

// Of a trial as it ended and of what the haptic model makes of its motion; null for what is no valid trial. Deviation
// (W17) is given twice: by distance to the wall, which is the headline, and to the proxy of the model. The two agree
// but where the hand leaves the tube and comes back elsewhere: the proxy hangs where it cannot follow. A trial in which
// they differ by more than kDeviationsAgree_mm in a point's mean is flagged. Contact and force are the model's; a
// flagged trial has none.
[[nodiscard]] Json trial_record(const StudyWorld& world, const StageState& end, std::span<const StageEvent> events,
                                const ModelTouch& model);
inline constexpr double kDeviationsAgree_mm = 1.0;
inline constexpr const char* kTorqueFigure = "torque_largest_Nm";
// Trials of before December 2026 have the first alone, in which both are counted.
inline constexpr const char* kFailedFigure = "failed_attempts";
inline constexpr const char* kInterruptedFigure = "interrupted_attempts";

// Returns the figures as the version had them that kept the others: a trial of before November 2026 has no torque, one
// of before December 2026 counts all attempts that failed as one number.
[[nodiscard]] Json as_kept_before(Json figures, const Json& kept);

// Of any other stage in which something was felt: contact and force as they were given to the hand.
[[nodiscard]] Json forces_record(const FeltForces& forces);

// Of one trial of the protocol and one participant, who has come to it. One without measures is a row too: lost, or a
// baseline, which is not analysed.
struct TrialRow {
    std::string participant, group, stratum, stage;
    std::size_t day = 1, number = 1;  // which of the protocol's trials, of all days, whether valid or not
    Json record;                      // by trial_record
    Hand hand = Hand::device;
    std::string world = {};
    std::size_t place = 1, run = 1;  // in the day's list of stages, and how often it was begun
    std::string reason = {};         // why there are no measures: "no attempt left: went back 3"; empty: they are there
    // Of attempts that failed: by what the person did, and by the operator or the device. Nothing: not told.
    std::optional<std::size_t> failed_attempts = {}, interrupted_attempts = {};
};
// CSV, with lines that say how the numbers came about and whose hands were simulated.
[[nodiscard]] std::string trials_csv(std::span<const TrialRow> rows);

// A whole sentence that says how many of the rows' participants are no persons, or held a device that no person felt;
// empty where all held one that is felt. Of rows with measures.
[[nodiscard]] std::string simulated_fact(std::span<const TrialRow> rows);

}  // namespace burin::study
