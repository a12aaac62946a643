// SPDX-License-Identifier: MIT
// The trials of a study as rows: the protocol's trials are numbered over all days, and each participant has a row for
// each one that they came to, valid or not. The table, the report's flow and its failures are counted from these alone,
// so that they agree. Reads the figures of the data; one thread.
#pragma once

#include <string>
#include <vector>

#include "study/folder/study_folder.hpp"
#include "study/people/recorded_trial.hpp"

namespace burin::study {

struct NumberedTrial {
    std::size_t number = 1;  // among the protocol's trials, from 1
    StagePlace at;
};
[[nodiscard]] std::vector<NumberedTrial> numbered_trials(const Protocol& protocol);
// How many of them are analysed.
[[nodiscard]] std::size_t outcome_trials(const Protocol& protocol);

struct TrialRows {
    std::vector<TrialRow> rows;               // by participant, in the journal's order, then by trial
    std::vector<std::string> damage;          // a line for each file that is missing or damaged; its row says so too
    [[nodiscard]] std::size_t valid() const;  // rows with measures
};
// Leaves out who has withdrawn.
[[nodiscard]] TrialRows trial_rows(const StudyFolder& study);

// How attempts of a trial failed; the journal counts them by the reason's name.
struct FailureCounts {
    std::size_t of_person = 0, of_operator_or_device = 0;
    bool never_begun = false;  // nobody came into the start cap
};
[[nodiscard]] FailureCounts failure_counts(const StageVisit& visit);

// Where everybody of a group who was enrolled is, each in one place.
struct FlowOfGroup {
    std::string group;
    std::size_t allocated = 0, withdrew = 0;
    // Without a valid outcome trial: stages are left, or all were gone through.
    std::size_t unfinished = 0, without_valid_trial = 0;
    // Analysed: with valid trials of all outcome trials of the protocol, or of some.
    std::size_t with_all = 0, with_some = 0;

    [[nodiscard]] std::size_t not_analysed() const { return withdrew + unfinished + without_valid_trial; }
    [[nodiscard]] std::size_t analysed() const { return with_all + with_some; }
};
[[nodiscard]] std::vector<FlowOfGroup> flow_of_groups(const StudyFolder& study, const TrialRows& trials);

}  // namespace burin::study
