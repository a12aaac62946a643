// SPDX-License-Identifier: MIT
// A study's table of trials, and whole sentences that tell how far its participants came and which trials were taken.
// make_trials() writes a file; the others are pure. One thread.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::study {

// Whole sentences: protocol, seed, how many people came how far, damage, and that learners were simulated.
[[nodiscard]] std::vector<std::string> study_facts(const StudyFolder& study);

// Takes a line for each file of data that is missing or damaged. The others are used.
using TellDamage = std::function<void(const std::string&)>;

// Writes the folder's trials.csv anew from journal and data, unless it is there as it would be. The trials of withdrawn
// participants are left out. Fails where nobody has come to a trial yet.
struct TrialsMade {
    std::size_t trials = 0;   // valid outcome trials
    std::size_t without = 0;  // rows without measures: lost, or a baseline
    std::vector<std::string> facts;
    std::vector<std::string> groups;  // in the protocol's order
    std::string simulated;            // a sentence where not all participants are persons with a device
    std::string pooled;  // a sentence where they are of several days or worlds, whose means are taken together

    [[nodiscard]] std::string count_text() const;  // "2 trials, and 1 rows without measures (lost, or a baseline)"
};
[[nodiscard]] Result<TrialsMade> make_trials(const StudyFolder& study, const TellDamage& tell);

struct TrialChoice {
    std::optional<unsigned> day;  // nothing: of all days
    std::string stage;            // empty: of all stages
};
struct ChosenTrials {
    std::string table;
    std::string simulated;  // as of TrialsMade
};
// Returns the table of some of a study's trials. Fails where the protocol has no such day, or no such stage whose
// trials are analysed, or nobody a valid trial of them.
[[nodiscard]] Result<ChosenTrials> chosen_trials(const StudyFolder& study, const TrialChoice& choice,
                                                 const TellDamage& tell);

}  // namespace burin::study
