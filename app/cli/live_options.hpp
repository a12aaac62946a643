// SPDX-License-Identifier: MIT
// The options of a live session, which burin sculpt, world, seek and study run share.
#pragma once

#include <string>
#include <vector>

#include "app/cli/command_line.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "session/options/session_setup.hpp"

namespace burin::app {

inline constexpr const char* kInputHelp =
    "A recording, done again as it was; or a written log of a session's input, in its user's place, in simulated time";

// Adds the options to a command. Both must outlive the command line. Returns their names. `device_help` goes behind the
// help of --device.
std::vector<std::string> add_live_options(Command command, session::SessionSetup& options,
                                          const char* input_help = kInputHelp, const char* device_help = "");

// Three of them, for a command that has no others.
void add_mouse_option(Command command, session::SessionSetup& options);
void add_detail_option(Command command, session::SessionSetup& options);
void add_engine_option(Command command, compute::EngineChoice& engine);
void add_shadows_option(Command command, session::SessionSetup& options);
// The mirror planes of a workpiece.
void add_mirror_option(Command command, session::SessionSetup& options);

}  // namespace burin::app
