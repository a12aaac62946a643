// SPDX-License-Identifier: MIT
// The options of a live session, which burin sculpt and burin world share.
#pragma once

#include "app/command_line.hpp"
#include "session/state/session_options.hpp"

namespace burin::app {

// Adds the options to a command. Both must outlive the command line.
void add_live_options(Command command, session::LiveOptions& options);

}  // namespace burin::app
