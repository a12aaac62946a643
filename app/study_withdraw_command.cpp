// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/study_command.hpp"
#include "app/study_trials.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

Result<void> study_withdraw(const StudyWithdrawOptions& options) {
    auto study = study::StudyFolder::open(options.study, study::StudyAccess::write);
    if (!study) return std::unexpected(study.error());
    warn_of_journal(*study);
    if (const auto ok = study->withdraw(options.id, options.erase); !ok) return ok;
    if (options.erase)
        if (const auto made = make_trials(options.study); !made) return std::unexpected(made.error());
    std::printf("%s: withdrawn%s\n", options.id.c_str(),
                options.erase ? ", data erased; reports and pictures made before still hold its figures" : "");
    return {};
}

}  // namespace burin::app
