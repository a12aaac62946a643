// SPDX-License-Identifier: MIT
// burin hand [WORLD]: a hand in a glove, drawn and felt, among rigid things (activities/grasp/grasp.hpp).
#pragma once

#include <string>
#include <vector>

#include "activities/grasp/grasp_options.hpp"
#include "app/cli/command_table.hpp"
#include "base/error.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

[[nodiscard]] CommandRow hand_row();

struct HandSession {
    session::SessionSetup session;
    std::string grasp;  // a scripted hand that closes so; empty: none
    activities::GraspOptions options;
    std::vector<std::string> given;  // names of the options that the command line gave
};
void prepare_hand(HandSession& hand);  // its world, glove and tool, as they are where no option says else
[[nodiscard]] Result<void> hand(const HandSession& options);

}  // namespace burin::app
