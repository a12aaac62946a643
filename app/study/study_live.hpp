// SPDX-License-Identifier: MIT
// A participant's visit in a live session: the study's worlds as its scene, the activity, and the journal that keeps
// its stages.
#pragma once

#include <memory>
#include <string>

#include "activities/train/study_activity.hpp"
#include "app/study/study_run_command.hpp"
#include "session/options/session_options.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

// Whether a log is one of a session, by its first line; else it is a script of simulated time.
[[nodiscard]] bool is_session_log(const std::string& file);

// Refuses a recording as a participant's input: what it holds would be counted as theirs.
[[nodiscard]] Result<void> check_visit_input(const std::string& file);

// Gives the options of a participant's session: the study's worlds alone, touched with points; the operator's panel is
// in a window of its own, whatever the options say, so that the participant's picture has the page and no more.
[[nodiscard]] session::SculptOptions participant_session(const session::LiveOptions& live,
                                                         std::shared_ptr<activities::StudyActivity> activity);

// Opens the window, or plays the log. The folder must be open for writing.
[[nodiscard]] Result<void> run_live_visit(study::StudyFolder& study, const StudyRunOptions& options);

}  // namespace burin::app
