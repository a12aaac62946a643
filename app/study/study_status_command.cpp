// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/folder/interruption.hpp"
#include "study/folder/unnamed_files.hpp"

namespace burin::app {

Result<void> study_status(const std::string& folder) {
    BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::read));
    warn_of_journal(study);
    for (const std::string& fact : study_facts(study)) std::printf("%s\n", fact.c_str());
    const std::size_t stages = study::places_of(study.protocol()).size();
    for (const study::Participant& p : study.participants()) {
        std::size_t ended = 0;
        std::string aborted;
        for (const study::StageVisit& v : p.visits) {
            if (v.status == study::StageStatus::ended) ++ended;
            if (v.status == study::StageStatus::aborted)
                aborted += formatted("; aborted: %s (day %zu, stage %zu)", v.stage.c_str(), v.day, v.place);
        }
        const std::string with = p.held && !p.simulated && !p.visits.empty() ? "; with " + text_of(*p.held) : "";
        std::printf("%-12s %-10s %-10s %zu of %zu stages%s%s%s\n", p.id.c_str(), p.stratum.c_str(), p.group.c_str(),
                    ended, stages, with.c_str(), aborted.c_str(),
                    p.erased      ? "; erased"
                    : p.withdrawn ? "; withdrawn"
                                  : "");
    }
    for (const study::Participant& p : study.participants())
        for (const study::ProtocolDeviation& d : p.withdrawn ? std::vector<study::ProtocolDeviation>{} : p.deviations)
            std::printf("deviation from the protocol: %s, %s: %s\n", p.id.c_str(), d.utc.c_str(), d.text.c_str());
    for (const study::Interruption& one : study::interruptions_of(study))
        std::printf("interrupted: %s\n", one.text().c_str());
    std::size_t unnamed = 0;
    for (const study::UnnamedFile& one : study::unnamed_files(study)) {
        if (one.file == study::kDataFolder)
            std::printf("%s: %s; %s\n", one.file.c_str(), one.what.c_str(), one.remedy.c_str());
        else
            ++unnamed;
    }
    if (unnamed > 0)
        std::printf("%zu files of data stand in no line of the journal: burin study check names them\n", unnamed);
    std::printf("last digest of the journal: %s\n", study.journal().last_digest.c_str());
    return {};
}

namespace {

CommandAction add_study_status(Command command) {
    const auto study = std::make_shared<std::string>();
    command.option("STUDY", *study, kStudyHelp).required();
    return action([study] { return study_status(*study); });
}

}  // namespace

CommandRow study_status_row() {
    return {"status", "Who is in the study and how far; aborted stages; damage", add_study_status};
}

}  // namespace burin::app
