// SPDX-License-Identifier: MIT
// What the commands on a study's folder share: its table of trials and its flow of participants.
#pragma once

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
// where there is no valid outcome trial yet.
struct TrialsMade {
    std::size_t trials = 0;
    std::vector<std::string> facts;
};
[[nodiscard]] Result<TrialsMade> make_trials(const std::string& folder);

}  // namespace burin::app
