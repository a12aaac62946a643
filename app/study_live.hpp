// SPDX-License-Identifier: MIT
// A participant's visit in a live session: the study's world as files that a session reads, the activity, and the
// journal that keeps its stages.
#pragma once

#include "app/study_command.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

// Whether a log is one of a session, by its first line; else it is a script of simulated time.
[[nodiscard]] bool is_session_log(const std::string& file);

// Refuses a recording as a participant's input: what it holds would be counted as theirs.
[[nodiscard]] Result<void> check_visit_input(const std::string& file);

// Opens the window, or plays the log. The folder must be open for writing.
[[nodiscard]] Result<void> run_live_visit(study::StudyFolder& study, const StudyRunOptions& options);

}  // namespace burin::app
