// SPDX-License-Identifier: MIT
// Tells the damage of a study's folder and makes its table of trials, for the commands that analyse it.
#pragma once

#include <string>

#include "base/error.hpp"
#include "study/folder/study_folder.hpp"
#include "study/report/study_trials.hpp"

namespace burin::app {

// Prints the journal's damage and notes on standard error; none is an error by itself.
void warn_of_journal(const study::StudyFolder& study);

// Writes the folder's trials.csv anew from journal and data, and tells their damage. The trials of withdrawn
// participants are left out. Fails where nobody has come to a trial yet.
[[nodiscard]] Result<study::TrialsMade> make_trials(const std::string& folder);

// Returns the table of some of a study's trials. Fails where the protocol has no such day or stage, or nobody a trial.
[[nodiscard]] Result<study::ChosenTrials> chosen_trials(const std::string& folder, const study::TrialChoice& choice);

}  // namespace burin::app
