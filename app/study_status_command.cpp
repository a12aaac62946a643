// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/study_command.hpp"
#include "app/study_trials.hpp"
#include "base/text.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

Result<void> study_status(const std::string& folder) {
    const auto study = study::StudyFolder::open(folder, study::StudyAccess::read);
    if (!study) return std::unexpected(study.error());
    warn_of_journal(*study);
    for (const std::string& fact : study_facts(*study)) std::printf("%s\n", fact.c_str());
    const std::size_t stages = study::places_of(study->protocol()).size();
    for (const study::Participant& p : study->participants()) {
        std::size_t ended = 0;
        std::string aborted;
        for (const study::StageVisit& v : p.visits) {
            if (v.status == study::StageStatus::ended) ++ended;
            if (v.status == study::StageStatus::aborted)
                aborted += formatted("; aborted: %s (day %zu, stage %zu)", v.stage.c_str(), v.day, v.place);
        }
        std::printf("%-12s %-10s %-10s %zu of %zu stages%s%s\n", p.id.c_str(), p.stratum.c_str(), p.group.c_str(),
                    ended, stages, aborted.c_str(),
                    p.erased      ? "; erased"
                    : p.withdrawn ? "; withdrawn"
                                  : "");
    }
    std::printf("last digest of the journal: %s\n", study->journal().last_digest.c_str());
    return {};
}

}  // namespace burin::app
