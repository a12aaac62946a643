// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/study/study_command.hpp"
#include "app/study/study_trials.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

Result<void> study_enrol(const StudyEnrolOptions& options) {
    auto study = study::StudyFolder::open(options.study, study::StudyAccess::write);
    if (!study) return std::unexpected(study.error());
    warn_of_journal(*study);
    study->use_key(options.key);
    const auto made = study->enrol(options.id, options.codes, false);
    if (!made) return std::unexpected(made.error());
    std::printf("%s: stratum %s, place %zu, group %s\n", made->id.c_str(), made->stratum.c_str(), made->position,
                made->group.c_str());
    return {};
}

}  // namespace burin::app
