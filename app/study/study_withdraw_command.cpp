// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "base/try.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

Result<void> study_withdraw(const StudyWithdrawOptions& options) {
    BURIN_TRY(study, study::StudyFolder::open(options.study, study::StudyAccess::write));
    warn_of_journal(study);
    BURIN_TRY(deleted, study.withdraw(options.id, options.erase));
    std::printf("%s: withdrawn%s\n", options.id.c_str(),
                options.erase ? ", data and the journal's words about it erased; its code, its group and that it has "
                                "withdrawn stay"
                              : "");
    for (const std::string& one : deleted)
        std::printf("%s/%s told of it, and was deleted; make it anew with what is left\n", options.study.c_str(),
                    one.c_str());
    // Without a valid trial of somebody else there is no table.
    if (options.erase) static_cast<void>(make_trials(options.study));
    return {};
}

namespace {

CommandAction add_study_withdraw(Command command) {
    const auto options = std::make_shared<StudyWithdrawOptions>();
    command.option("STUDY", options->study, kStudyHelp).required();
    command.option("ID", options->id, "The participant's code").required();
    command.flag("--erase", options->erase,
                 "Delete the participant's data too, and all that journal and reports tell but for code and group");
    return action([options] { return study_withdraw(*options); });
}

}  // namespace

CommandRow study_withdraw_row() { return {"withdraw", "Excludes a participant", add_study_withdraw}; }

}  // namespace burin::app
