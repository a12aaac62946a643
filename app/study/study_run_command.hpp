// SPDX-License-Identifier: MIT
// burin study run, as its options are given: simulated learners, or one participant, by a script or in a live session.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

struct StudyRunOptions {
    std::string study, key;
    std::string participant;              // one participant; empty: simulated learners
    session::SessionSetup session;        // its input: of a live session, or a script of simulated time
    std::vector<std::string> live_names;  // of its options
    bool simulated = false, without_motion = false, pictures = false;
    bool resume = false, any_delay = false;  // what of the protocol's calendar need not be kept
    double effect = 0.0;
    unsigned threads = 0;  // 0: one for each core
};
// Goes on where the journal ends. `given`: the names of the options that were given; fails where one has no effect.
[[nodiscard]] Result<void> study_run(const StudyRunOptions& options, const std::vector<std::string>& given);

}  // namespace burin::app
