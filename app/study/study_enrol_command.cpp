// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "base/try.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

Result<void> study_enrol(const StudyEnrolOptions& options) {
    BURIN_TRY(study, study::StudyFolder::open(options.study, study::StudyAccess::write));
    warn_of_journal(study);
    study.use_key(options.key);
    BURIN_TRY(made, study.enrol(options.id, options.codes, false));
    std::printf("%s: stratum %s, place %zu, group %s\n", made.id.c_str(), made.stratum.c_str(), made.position,
                made.group.c_str());
    return {};
}

namespace {

CommandAction add_study_enrol(Command command) {
    const auto options = std::make_shared<StudyEnrolOptions>();
    command.option("STUDY", options->study, kStudyHelp).required();
    command.option("ID", options->id, "A code such as p07, never a name").required();
    command.option("--key", options->key, "The allocation's key, where it is not in the folder");
    command.option("--codes", options->codes, "One code of each stratum, in the protocol's order");
    return action([options] { return study_enrol(*options); });
}

}  // namespace

CommandRow study_enrol_row() {
    return {"enrol", "Gives a participant the next place of the allocation", add_study_enrol};
}

}  // namespace burin::app
