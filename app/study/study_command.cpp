// SPDX-License-Identifier: MIT
#include "app/study/study_command.hpp"

namespace burin::app {
namespace {

CommandAction add_study(Command command) {
    command.require_subcommand();
    return add_commands(command, {study_init_row(), study_check_row(), study_enrol_row(), study_run_row(),
                                  study_replay_row(), study_status_row(), study_withdraw_row(), study_report_row(),
                                  study_analyse_row(), study_power_row()});
}

}  // namespace

CommandRow study_row() { return {"study", "A study, from protocol to report", add_study}; }

}  // namespace burin::app
