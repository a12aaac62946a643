// SPDX-License-Identifier: MIT
// What the commands on a study's folder share: its table of trials and its flow of participants.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

// Whole sentences: protocol, seed, how many people came how far, damage, and that learners were simulated.
[[nodiscard]] std::vector<std::string> study_facts(const study::StudyFolder& study);

// Prints the journal's damage and notes on standard error; none is an error by itself.
void warn_of_journal(const study::StudyFolder& study);

// Writes the folder's trials.csv anew from journal and data. The trials of withdrawn participants are left out. Fails
// where nobody has come to a trial yet.
struct TrialsMade {
    std::size_t trials = 0;   // valid outcome trials
    std::size_t without = 0;  // rows without measures: lost, or a baseline
    std::vector<std::string> facts;
    std::vector<std::string> groups;  // in the protocol's order
    std::string simulated;            // a sentence where not all participants are persons with a device
    std::string pooled;  // a sentence where they are of several days or worlds, whose means are taken together

    [[nodiscard]] std::string count_text() const;  // "2 trials, and 1 rows without measures (lost, or a baseline)"
};
[[nodiscard]] Result<TrialsMade> make_trials(const std::string& folder);

struct TrialChoice {
    std::optional<unsigned> day;  // nothing: of all days
    std::string stage;            // empty: of all stages
};
struct ChosenTrials {
    std::string table;
    std::string simulated;  // as of TrialsMade
};
// Returns the table of some of a study's trials. Fails where the protocol has no such day or stage, or nobody a trial.
[[nodiscard]] Result<ChosenTrials> chosen_trials(const std::string& folder, const TrialChoice& choice);

}  // namespace burin::app
