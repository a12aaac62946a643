// SPDX-License-Identifier: MIT
#include "app/study/study_trials.hpp"

#include <cstdio>

#include "base/try.hpp"

namespace burin::app {
namespace {

void tell_damage(const std::string& line) { std::fprintf(stderr, "without measures: %s\n", line.c_str()); }

}  // namespace

void warn_of_journal(const study::StudyFolder& study) {
    const std::string file = (study.path() / "journal.jsonl").string();
    for (const study::JournalFault& f : study.journal().faults)
        std::fprintf(stderr, "%s:%zu: %s; %s\n", file.c_str(), f.line, f.what.c_str(), f.remedy.c_str());
    for (const std::string& note : study.journal().notes) std::fprintf(stderr, "%s: %s\n", file.c_str(), note.c_str());
}

Result<study::TrialsMade> make_trials(const std::string& folder) {
    BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::read));
    warn_of_journal(study);
    return study::make_trials(study, tell_damage);
}

Result<study::ChosenTrials> chosen_trials(const std::string& folder, const study::TrialChoice& choice) {
    BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::read));
    return study::chosen_trials(study, choice, tell_damage);
}

}  // namespace burin::app
