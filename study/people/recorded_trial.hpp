// SPDX-License-Identifier: MIT
// What a study folder keeps of a trial: its metrics, and the table of all trials that burin study analyse reads. Pure;
// any thread.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "study/people/learner.hpp"

namespace burin::study {

// Null for what is no valid trial. Deviation is by distance to the wall; there is no force in it.
[[nodiscard]] Json trial_record(const StudyWorld& world, const SimulatedStage& stage);

struct TrialRow {
    std::string participant, group, stratum, stage;
    std::size_t day = 1, number = 1;  // which outcome trial of the participant
    Json record;                      // by trial_record
};
// CSV, with a line that says how the numbers came about.
[[nodiscard]] std::string trials_csv(std::span<const TrialRow> rows, bool simulated);

}  // namespace burin::study
